//! A root of a function of time between two times at which its signs differ.

use crate::error::Error;

/// The time in `[low, high]` at which `f` changes its sign, to the spacing of doubles at the larger of it and
/// of the bracket's width, or to the rounding of `f`.
///
/// The search begins at `guess`, or at the middle if that is outside. `f` gives value and derivative; `rising` says that it is positive at `high` and not at `low`, or the other way round.
/// Newton's steps, halved to the bracket where they leave it or do not shrink it.
pub(super) fn root(
    (mut low, mut high): (f64, f64),
    guess: f64,
    rising: bool,
    f: impl Fn(f64) -> Result<(f64, f64), Error>,
) -> Result<f64, Error> {
    let width = high - low;
    let mut t = if low < guess && guess < high { guess } else { low + width / 2.0 };
    let mut last_step = width;
    loop {
        let (value, slope) = f(t)?;
        if (value > 0.0) == rising {
            high = t;
        } else {
            low = t;
        }
        let newton = t - value / slope;
        let step = (newton - t).abs();
        let next = if newton > low && newton < high && step < 0.5 * last_step {
            last_step = step;
            newton
        } else {
            last_step = high - low;
            low + (high - low) / 2.0
        };
        let spacing = f64::EPSILON * t.abs().max(width);
        if step <= spacing || high - low <= spacing || next <= low || next >= high {
            return Ok(if newton > low && newton < high { newton } else { t });
        }
        t = next;
    }
}
