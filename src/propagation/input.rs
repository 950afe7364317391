//! What motions refuse besides what a problem does.

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
        "within the span for which the motion was asked",
    )
}
