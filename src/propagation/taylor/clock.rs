//! Progress of a motion: time and number of steps.

use crate::error::Error;
use crate::numerics::compensated::Compensated;

/// Time since the start of a motion, positive in either direction, and the steps taken so far.
pub(super) struct Clock {
    elapsed: Compensated,
    pub(super) steps: usize,
}

/// One step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interval {
    /// Time since the start of the motion at which it begins.
    pub(super) start: Compensated,
    /// Time since the start of the motion at which the next one begins; infinite for the last.
    pub(super) end: f64,
    /// Its length.
    pub(super) length: f64,
}

impl Interval {
    pub(super) fn is_last(&self) -> bool {
        self.end == f64::INFINITY
    }
}

/// Largest number of steps of a motion, as a number and in words.
#[derive(Clone, Copy)]
pub(super) struct StepLimit {
    pub(super) steps: usize,
    pub(super) allowed: &'static str,
}

impl Clock {
    pub(super) fn new() -> Self {
        Self { elapsed: Compensated::new(0.0), steps: 0 }
    }

    /// The next step, of the length `wanted` or up to the end of `duration`.
    #[inline(always)]
    pub(super) fn advance(&mut self, wanted: f64, duration: f64, limit: StepLimit) -> Result<Interval, Error> {
        check_length(self.steps, limit, self.elapsed.high, duration)?;
        Error::ensure(
            wanted > 0.0,
            "step of the motion",
            wanted,
            "above zero; in these units the motion is out of range",
        )?;
        let start = self.elapsed;
        let remaining = (duration - start.high) - start.low;
        let last = wanted >= remaining;
        let length = if last { remaining } else { wanted };
        self.elapsed.add(length);
        self.steps += 1;
        let end = if last { f64::INFINITY } else { self.elapsed.high };
        Ok(Interval { start, end, length })
    }
}

/// Refuses a motion that has too many steps, or whose first steps show that it will have.
fn check_length(steps: usize, limit: StepLimit, elapsed: f64, duration: f64) -> Result<(), Error> {
    let foreseen = steps as f64 * duration / elapsed.max(f64::MIN_POSITIVE);
    let hopeless = steps >= 256 && foreseen > 2.0 * limit.steps as f64;
    Error::ensure(steps < limit.steps && !hopeless, "length of the motion in its own steps", foreseen, limit.allowed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tenth of the motion took 300 steps: 3,000 are foreseen. Fewer than 256 foresee nothing, and twice the limit may be an irregular start.
    #[test]
    fn a_refused_length_is_the_one_foreseen() {
        let limit = StepLimit { steps: 1000, allowed: "at most 1000" };
        let refused = check_length(300, limit, 0.2, 2.0).unwrap_err();
        let quantity = "length of the motion in its own steps";
        assert_eq!(refused, Error::Domain { quantity, value: 3000.0, allowed: "at most 1000" });
        assert!(check_length(255, limit, 0.2, 2.0).is_ok() && check_length(300, limit, 0.4, 2.0).is_ok());
        assert!(check_length(1000, limit, 2.0, 2.0).is_err());
    }
}
