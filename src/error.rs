//! Errors: a value out of its domain, something that is not supported, or an iteration that did not converge.

use core::fmt;

/// A quantity outside the domain of the equation it was given to, or a computation that could not be completed.
#[derive(Debug, Clone, PartialEq)]
pub enum Error {
    /// A value outside the domain of an equation.
    Domain {
        /// The quantity, by its name in the field and its symbol.
        quantity: &'static str,
        /// The offending value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// Something that cannot be had where it is asked for, whatever the numbers are.
    Unsupported {
        /// What was asked for.
        what: &'static str,
        /// Why it is not there.
        why: &'static str,
    },
    /// An iteration that did not reach its goal.
    NotConverged {
        /// What was being solved.
        what: &'static str,
        /// Iterations spent.
        iterations: usize,
        /// Remaining residual; not a number where nothing was found.
        residual: f64,
    },
}

/// The error in words, so that `?` serves functions whose errors are texts.
impl From<Error> for String {
    fn from(error: Error) -> Self {
        error.to_string()
    }
}

impl Error {
    /// Refuses `value` unless `allowed_if` holds (NaN never does).
    pub fn ensure(allowed_if: bool, quantity: &'static str, value: f64, allowed: &'static str) -> Result<(), Self> {
        if allowed_if { Ok(()) } else { Err(Error::Domain { quantity, value, allowed }) }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Domain { quantity, value, allowed } => {
                // Decimals as long as they are short.
                if *value == 0.0 || (1e-5..1e16).contains(&value.abs()) || !value.is_finite() {
                    write!(f, "{quantity} = {value}: allowed is {allowed}")
                } else {
                    write!(f, "{quantity} = {value:e}: allowed is {allowed}")
                }
            }
            Error::Unsupported { what, why } => write!(f, "{what}: {why}"),
            Error::NotConverged { what, residual, .. } if residual.is_nan() => write!(f, "{what}: not found"),
            Error::NotConverged { what, iterations, residual } => {
                write!(f, "{what}: no convergence in {iterations} iterations, residual {residual:e}")
            }
        }
    }
}

impl std::error::Error for Error {}
