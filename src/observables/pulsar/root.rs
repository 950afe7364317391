//! A root of a function of time between two times at which its signs differ.

use crate::error::Error;

/// What is known of a function at one time, for the search of its root.
pub(super) struct Look {
    /// Value there.
    pub(super) value: f64,
    /// Estimated distance from there to the root.
    pub(super) step: f64,
    /// Whether that is known to be exact to rounding.
    pub(super) is_exact: bool,
}

/// The time in `[low, high]` at which a function changes its sign, to the spacing of doubles at the larger of it and
/// of the bracket's width, or to the rounding of the function.
///
/// The search begins at `guess`, or at the middle if that is outside. `rising` says that the function is positive at `high` and not
/// at `low`, or the other way round. Steps are halved to the bracket where they leave it or do not shrink it.
pub(super) fn root(
    (mut low, mut high): (f64, f64),
    guess: f64,
    rising: bool,
    look_at: impl Fn(f64) -> Result<Look, Error>,
) -> Result<f64, Error> {
    let width = high - low;
    let mut t = if low < guess && guess < high { guess } else { low + width / 2.0 };
    let mut last_step = width;
    loop {
        let Look { value, step, is_exact } = look_at(t)?;
        if (value > 0.0) == rising {
            high = t;
        } else {
            low = t;
        }
        let target = t + step;
        let is_within = target > low && target < high;
        let length = (target - t).abs();
        let next = if is_within && length < 0.5 * last_step {
            last_step = length;
            target
        } else {
            last_step = high - low;
            low + (high - low) / 2.0
        };
        let spacing = f64::EPSILON * t.abs().max(width);
        let is_done = is_exact && is_within;
        if is_done || length <= spacing || high - low <= spacing || next <= low || next >= high {
            return Ok(if is_within { target } else { t });
        }
        t = next;
    }
}
