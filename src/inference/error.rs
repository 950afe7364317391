//! Errors of parameter estimation.

use std::fmt;

use super::Observable;
use crate::error::Error;

/// Reasons why nothing can be inferred.
#[derive(Debug, Clone, PartialEq)]
pub enum InferenceError {
    /// The data do not determine the unknowns. Lists each direction along which the data do not change.
    Degenerate(Vec<String>),
    /// There are fewer data than the unknowns require.
    TooFew {
        /// Number of data.
        data: usize,
        /// Number of data required: the number of unknowns for a Fisher matrix, one more for a fit.
        least: usize,
    },
    /// A datum belongs to a turn in which the model has no pulse, or two.
    NoPulse {
        /// The turn.
        turn: i64,
        /// Time of the datum.
        near: f64,
    },
    /// The least-squares fit did not end at a minimum.
    NotConverged {
        /// Why the fit ended.
        why: &'static str,
        /// Largest cosine of the angle between the residuals and the derivative by an unknown: zero at a minimum.
        cosine: f64,
    },
    /// The spacing of doubles at the value of an unknown is not small compared with the standard deviation of the unknown.
    Coarse {
        /// The unknown.
        unknown: &'static str,
        /// This spacing, in standard deviations.
        step: f64,
    },
    /// The residuals are rounding errors, and the stated errors are too small for a fit to them.
    Rounding {
        /// The kind of data whose stated errors are smallest relative to rounding.
        observable: Observable,
        /// Rounding error of these data, in `t_c` or as strain.
        rounding: f64,
    },
    /// The fit ended on a limit of an unknown, where its error bars are meaningless.
    OnLimit {
        /// The unknown.
        unknown: &'static str,
        /// Its limit.
        value: f64,
    },
    /// The motion cannot be computed.
    Model(Error),
}

impl From<Error> for InferenceError {
    fn from(error: Error) -> Self {
        Self::Model(error)
    }
}

impl From<InferenceError> for String {
    fn from(error: InferenceError) -> Self {
        error.to_string()
    }
}

impl fmt::Display for InferenceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Degenerate(directions) => {
                write!(f, "the data do not determine all unknowns; they do not change along")?;
                directions.iter().try_for_each(|direction| write!(f, "\n  {direction}"))?;
                write!(f, "\nleave out one of each, or add data of another kind")
            }
            Self::TooFew { data, least } => {
                write!(f, "the number of data is {data}: must be at least {least} for so many unknowns")
            }
            Self::NoPulse { turn, near } => write!(
                f,
                "datum of turn {turn} near t = {near:?} t_c: the model has no whole pulse there that is the only one of its turn; \
                 use only pulses that the model has at the start of the fit"
            ),
            Self::NotConverged { why, cosine } if cosine.is_nan() => write!(f, "the fit did not begin: {why}"),
            Self::NotConverged { why, cosine } => write!(
                f,
                "the fit did not end at a minimum ({why}; the residuals have a cosine of {cosine:.1e} with a derivative); a start \
                 nearer to the data may help"
            ),
            Self::Coarse { unknown, step } => write!(
                f,
                "the fit did not end at a minimum: the last digit of {unknown} as a double is {step:.1e} of its standard deviation, and a fit must \
                 resolve a hundredth of it; use larger standard deviations"
            ),
            Self::Rounding { observable, rounding } => write!(
                f,
                "the residuals are only rounding errors: the scene agrees with the data to the precision of doubles, {} to {rounding:.1e}{}. A fit must \
                 resolve a hundredth of a standard deviation; use larger ones in --observe ({:.1e}{1} is certain to work)",
                observable.key(),
                if observable.is_of_pulses() { " t_c" } else { "" },
                100.0 * rounding
            ),
            Self::OnLimit { unknown, value } => {
                write!(
                    f,
                    "the fit ended at {unknown} = {value:?}, a limit of its range; error bars are not valid there"
                )
            }
            Self::Model(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for InferenceError {}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fit ends a hundredth of an error from its minimum, which has to be more than the rounding of a datum.
    #[test]
    fn errors_above_the_rounding_of_a_fit_are_named() {
        let told = InferenceError::Rounding { observable: Observable::Widths, rounding: 2e-14 }.to_string();
        assert!(told.contains("widths to 2.0e-14 t_c") && told.ends_with("(2.0e-12 t_c is certain to work)"), "{told}");
    }

    /// Without a first step there are no residuals, and no cosine.
    #[test]
    fn a_fit_that_did_not_begin_is_told_from_one_that_ended_off_a_minimum() {
        let told = |cosine: f64| InferenceError::NotConverged { why: "no step", cosine }.to_string();
        assert_eq!(told(f64::NAN), "the fit did not begin: no step");
        assert!(
            told(0.25).starts_with("the fit did not end at a minimum (no step; the residuals have a cosine of 2.5e-1")
        );
    }
}
