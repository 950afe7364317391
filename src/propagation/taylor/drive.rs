//! The steps of a motion, one after the other.

use nalgebra::Matrix3;

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::propagation::arithmetic::{Arithmetic, Stored};
use crate::propagation::taylor::compensated::{Compensated, CompensatedState};
use crate::propagation::taylor::error_growth::ErrorGrowth;
use crate::propagation::taylor::series::{Recurrence, Vectors, change};
use crate::propagation::taylor::step_size::{Scale, step_size};
use crate::scalar::Real;

/// What the steps follow from.
pub(super) struct Drive<'a, S, const V: usize> {
    pub(super) spheroid: &'a RigidSpheroid<S>,
    /// Traceless, in the frame of the series.
    pub(super) violation: &'a Matrix3<S>,
    /// In the frame of the series.
    pub(super) start: &'a Vectors<Stored<S>, V>,
    pub(super) scale: &'a Scale,
    pub(super) order: usize,
    pub(super) duration: f64,
    /// `1` forwards in time, `-1` backwards.
    pub(super) direction: f64,
    /// Truncation error per unit of time.
    pub(super) budget: f64,
}

/// A step with its series, and the errors made up to its end.
pub(super) struct Step<'a, S, const V: usize> {
    /// Start of the step: time since the start of the motion, positive in either direction.
    pub(super) start: Compensated,
    /// Time since the start of the motion at which the next step begins; infinite for the last.
    pub(super) end: f64,
    /// Errors made up to the end of the step.
    pub(super) error: ErrorGrowth,
    /// The coefficients.
    pub(super) series: &'a [Vectors<Stored<S>, V>],
}

impl<S: Real, const V: usize> Drive<'_, S, V> {
    /// Steps from the start to the end of the span, at most `limit`, and gives each to `visit`.
    #[inline(always)]
    pub(super) fn run<A: Arithmetic<Scalar = S>>(
        &self,
        a: A,
        limit: StepLimit,
        mut visit: impl FnMut(Step<'_, S, V>),
    ) -> Result<(), Error> {
        let Drive { scale, order, duration, direction, budget, .. } = *self;
        let mut recurrence = Recurrence::<A, V>::new(a, self.spheroid, self.violation, order, scale.time);
        let mut series = vec![[Stored::zero(); V]; order + 1];
        let mut elapsed = Compensated::new(0.0);
        let mut state = CompensatedState::new(a, self.start.map(|v| a.load(&v)));
        let mut error = ErrorGrowth::of_rounded_start();
        let mut count = 0;
        loop {
            check_length(count, limit, elapsed.high, duration)?;
            recurrence.expand(&state.high, &mut series);
            let step = step_size(a, &series, scale, budget);
            Error::unless(
                step > 0.0,
                "step of the motion",
                step,
                "above zero: in these units the motion is out of range",
            )?;
            let remaining = (duration - elapsed.high) - elapsed.low;
            let last = step >= remaining;
            let step = if last { remaining } else { step };
            error.add(elapsed.high, budget * step);
            let start = elapsed;
            elapsed.add(step);
            let end = if last { f64::INFINITY } else { elapsed.high };
            visit(Step { start, end, error, series: &series });
            if last {
                return Ok(());
            }
            state.add(a, &change(a, &series, S::from_f64(step * direction / scale.time)));
            count += 1;
        }
    }
}

/// Most steps that a motion may have, in numbers and in words.
#[derive(Clone, Copy)]
pub(super) struct StepLimit {
    pub(super) steps: usize,
    pub(super) allowed: &'static str,
}

/// Refuses a motion that has too many steps, or that has shown within its first steps that it will have.
fn check_length(steps: usize, limit: StepLimit, elapsed: f64, duration: f64) -> Result<(), Error> {
    let foreseen = steps as f64 * duration / elapsed.max(f64::MIN_POSITIVE);
    let hopeless = steps >= 256 && foreseen > 2.0 * limit.steps as f64;
    Error::unless(steps < limit.steps && !hopeless, "length of the motion in its own steps", foreseen, limit.allowed)
}
