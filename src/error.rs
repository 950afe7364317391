//! Errors: a value out of its domain, an unsupported request, or an iteration that did not converge.

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
        /// The allowed values, in words that follow "must be".
        allowed: &'static str,
    },
    /// A request that cannot be met, or a search that found nothing.
    Unsupported {
        /// The request.
        what: &'static str,
        /// The reason.
        why: &'static str,
    },
    /// An iteration that did not converge.
    NotConverged {
        /// The equation or quantity being solved for.
        what: &'static str,
        /// Iterations spent.
        iterations: usize,
        /// Remaining residual.
        residual: f64,
    },
}

/// The error as text, so that `?` works in functions whose errors are strings.
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

    /// The error of a search for `what` that found nothing.
    pub fn not_found(what: &'static str) -> Self {
        Error::Unsupported { what, why: "not found" }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Domain { quantity, value, allowed } => {
                // Decimal notation as long as it is short.
                if *value == 0.0 || (1e-5..1e16).contains(&value.abs()) || !value.is_finite() {
                    write!(f, "{quantity} = {value}: must be {allowed}")
                } else {
                    write!(f, "{quantity} = {value:e}: must be {allowed}")
                }
            }
            Error::Unsupported { what, why } => write!(f, "{what}: {why}"),
            Error::NotConverged { what, iterations, residual } => {
                write!(f, "{what}: no convergence in {iterations} iterations, residual {residual:e}")
            }
        }
    }
}

impl std::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refused_number_is_decimal_as_long_as_that_is_short() {
        let told = |value: f64| Error::Domain { quantity: "x", value, allowed: "1" }.to_string();
        for (value, text) in
            [(3.0, "3"), (-3.0, "-3"), (0.0, "0"), (-2e-6, "-2e-6"), (-1e17, "-1e17"), (f64::NEG_INFINITY, "-inf")]
        {
            assert_eq!(told(value), format!("x = {text}: must be 1"));
        }
    }
}
