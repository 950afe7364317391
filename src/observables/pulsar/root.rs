//! Finds a root of a function of time between two times at which its signs differ.

use crate::error::Error;

/// Information about a function at one time, for the search of its root.
pub(super) struct Look {
    /// Value there.
    pub(super) value: f64,
    /// Estimated distance from there to the root.
    pub(super) step: f64,
    /// Whether this distance is known to be exact to rounding.
    pub(super) is_exact: bool,
}

/// The time in `[low, high]` at which a function changes its sign, to the spacing of doubles at the larger of this time and
/// the width of the bracket, or to the rounding of the function.
///
/// The search begins at `guess`, or at the middle if that is outside. If `rising`, the function is positive at `high` and not at
/// `low`, otherwise the other way round. Steps are replaced by bisection where they leave the bracket or do not shrink it.
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

#[cfg(test)]
mod tests {
    use core::cell::RefCell;

    use super::*;

    /// The times that are evaluated, for a root at `at` of a rising function whose steps are given in order, followed by steps
    /// that are too long.
    fn looks(bracket: (f64, f64), guess: f64, at: f64, steps: &[f64]) -> Vec<f64> {
        let seen = RefCell::new(Vec::new());
        let look = |t: f64| {
            let mut seen = seen.borrow_mut();
            seen.push(t);
            let step = steps.get(seen.len() - 1).copied().unwrap_or(1e9);
            Ok(Look { value: t - at, step, is_exact: false })
        };
        let found = root(bracket, guess, true, look).unwrap();
        assert!((found - at).abs() <= 2.0 * f64::EPSILON * (bracket.1 - bracket.0).max(at.abs()), "{found}");
        seen.into_inner()
    }

    /// The search begins at the guess, or in the middle; steps that leave the bracket or do not shrink are replaced by
    /// bisection.
    #[test]
    fn times_that_are_looked_at_are_those_of_the_rules() {
        let none: &[f64] = &[];
        for (guess, steps, expected) in [
            (3.0, none, &[3.0][..]),
            (1.0, none, &[6.0]),
            (2.0, none, &[6.0]),
            (10.0, none, &[6.0]),
            (11.0, none, &[6.0]),
            (f64::NAN, none, &[6.0, 8.0, 7.0, 7.5, 7.25]),
            // The first step may be as long as half the bracket.
            (3.0, &[4.5], &[3.0, 6.5, 8.25]),
            (3.0, &[3.9], &[3.0, 6.9, 8.45]),
            // 2 is less than half of 8, 0.9 less than half of 2, 0.5 not less than half of 0.9: then the bracket is [5.9, 10].
            (3.0, &[2.0, 0.9, 0.5], &[3.0, 5.0, 5.9, 7.95]),
            // After that the criterion is again half of the bracket's length, 2.05.
            (3.0, &[2.0, 0.9, 0.5, -2.0], &[3.0, 5.0, 5.9, 7.95, 5.95]),
            (3.0, &[2.0, 0.9, 0.5, -2.06], &[3.0, 5.0, 5.9, 7.95, 6.925000000000001]),
        ] {
            assert_eq!(looks((2.0, 10.0), guess, 7.3, steps)[..expected.len()], *expected, "{guess} {steps:?}");
        }
    }

    #[test]
    fn exact_steps_end_the_search() {
        let seen = RefCell::new(0);
        let look = |t: f64| {
            *seen.borrow_mut() += 1;
            Ok(Look { value: 7.25 - t, step: 7.25 - t, is_exact: true })
        };
        assert_eq!(root((2.0, 10.0), 3.0, false, look), Ok(7.25));
        assert_eq!(*seen.borrow(), 1);
    }
}
