//! Input checks for motions, beyond those of `Problem`.

use crate::error::Error;
use crate::propagation::TOLERANCE_RANGE;

/// Refuses a tolerance out of range and a span that is not finite.
pub(crate) fn check_request(span: (f64, f64), tolerance: f64) -> Result<(), Error> {
    let (least, most) = TOLERANCE_RANGE;
    Error::ensure(least <= tolerance && tolerance <= most, "tolerance", tolerance, "between 1e-16 and 1e-2")?;
    for time in [span.0, span.1] {
        Error::ensure(time.is_finite(), "end of the time span", time, "a finite number")?;
    }
    Ok(())
}

/// Refuses a time outside the span of a motion, whose ends may be in either order.
pub(crate) fn check_time((first, last): (f64, f64), t: f64) -> Result<(), Error> {
    Error::ensure(
        first.min(last) <= t && t <= first.max(last),
        "time t",
        t,
        "within the span for which the motion was requested",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_have_a_range_and_spans_an_end() {
        for tolerance in [1e-16, 1e-9, 1e-2] {
            assert_eq!(check_request((0.0, -3.0), tolerance), Ok(()));
        }
        for tolerance in [0.9e-16, 0.011, 1.0, f64::NAN] {
            assert!(check_request((0.0, -3.0), tolerance).is_err(), "{tolerance}");
        }
        assert!(check_request((f64::NEG_INFINITY, 3.0), 1e-9).is_err());
        assert!(check_request((0.0, f64::NAN), 1e-9).is_err());
    }

    #[test]
    fn times_lie_between_the_ends_in_either_order() {
        for span in [(-1.0, 2.0), (2.0, -1.0)] {
            assert!([-1.0, 0.5, 2.0].iter().all(|t| check_time(span, *t).is_ok()));
            assert!([-1.1, 2.1, f64::NAN].iter().all(|t| check_time(span, *t).is_err()));
        }
    }
}
