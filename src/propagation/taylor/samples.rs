//! States at given times, without storing the motion between them.

use nalgebra::Vector3;

use crate::dynamics::{AxisState, Problem, RotationState};
use crate::error::Error;
use crate::numerics::arithmetic::{LoadStore, plain};
use crate::numerics::fused::run_fused;
use crate::numerics::scalar::{Real, Scalar};
use crate::propagation::taylor::clock::{Interval, StepLimit};
use crate::propagation::taylor::scaled_problem::ScaledProblem;
use crate::propagation::taylor::{fused_for, work_of};
use crate::propagation::third_angle::body_state;

/// Largest number of steps of a motion that is not stored: they take about an hour.
pub(super) const LIMIT: StepLimit =
    StepLimit { steps: 10_000_000_000, allowed: "at most 1e10 steps; use earlier times or a larger tolerance" };

/// States at given times.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples<T> {
    /// One state for each requested time, in order.
    pub states: Vec<T>,
    /// Number of steps of the motion.
    pub step_count: usize,
    /// Order of its series, or of its splitting scheme.
    pub order: usize,
}

impl<S: Real, X: RotationState<S>> Problem<S, X> {
    /// States of the numerical motion that begins at the time `start`, at the requested `times`: the same numbers as those of
    /// [`taylor`](Self::taylor) over the span from `start` to the last of them, without storing the motion in between. Memory does not
    /// grow with the span; a motion may have 1e10 steps.
    ///
    /// # Errors
    /// As for [`taylor`](Self::taylor) except for the number of steps, and [`Error::Domain`] if there are no times or if the
    /// times do not lie on one side of `start`, in the order in which the motion reaches them.
    pub fn taylor_states(&self, start: f64, times: &[f64], tolerance: f64) -> Result<Samples<X>, Error> {
        if const { X::VECTORS == 3 } {
            let AxisState { axis, momentum } = self.initial().axis_state();
            let rate = self.spheroid().rate_about_axis(&axis, &momentum);
            let state = |vectors, t| X::from_vectors(body_state(vectors, rate * (t - S::from_f64(start))).vectors());
            sampled(self, start, times, tolerance, state)
        } else {
            let state = |[n, l]: [Vector3<S>; 2], _| X::from_vectors([n, l, Vector3::zeros()]);
            sampled(self, start, times, tolerance, state)
        }
    }
}

/// The span from the start to the last of the times. The times must be in the order in which a motion reaches them.
pub(in crate::propagation) fn span_of(start: f64, times: &[f64]) -> Result<(f64, f64), Error> {
    let Some(&last) = times.last() else {
        return Err(Error::Domain { quantity: "number of times", value: 0.0, allowed: "at least one" });
    };
    let mut before = start;
    for &t in times {
        let onwards = if last >= start { before <= t && t <= last } else { before >= t && t >= last };
        Error::ensure(onwards, "time t", t, "not before the preceding time, in the direction of the motion")?;
        before = t;
    }
    Ok((start, last))
}

fn sampled<S: Real, X: RotationState<S>, T, const V: usize>(
    problem: &Problem<S, X>,
    start: f64,
    times: &[f64],
    tolerance: f64,
    state: impl Fn([Vector3<S>; V], S) -> T,
) -> Result<Samples<T>, Error> {
    let span = span_of(start, times)?;
    if let Some(fused) = fused_for::<S>() {
        let real = ScaledProblem::<_, V>::new(work_of(Some(fused)), &problem.map(S::re), span, tolerance)?;
        let samples = run_fused(
            fused,
            #[inline(always)]
            || visited(&real, fused, times, |vectors, t| (vectors, t)),
        )?;
        let Samples { states, step_count, order } = samples;
        let given = |(vectors, t): ([Vector3<f64>; V], f64)| state(vectors.map(|v| v.map(S::from_f64)), S::from_f64(t));
        return Ok(Samples { states: states.into_iter().map(given).collect(), step_count, order });
    }
    let setup = ScaledProblem::new(work_of(None), problem, span, tolerance)?;
    visited(&setup, plain(), times, state)
}

/// Evaluates each step at the times within it.
#[inline(always)]
pub(super) fn visited<A: LoadStore, T, const V: usize>(
    setup: &ScaledProblem<A::Scalar, V>,
    a: A,
    times: &[f64],
    state: impl Fn([Vector3<A::Scalar>; V], A::Scalar) -> T,
) -> Result<Samples<T>, Error> {
    let mut samples = Samples::with_room(times.len(), setup.order);
    // A closure that is not inlined is compiled without AVX2, and each vector operation then becomes a call.
    setup.drive().run(
        a,
        LIMIT,
        #[inline(always)]
        |step, series| {
            samples.step_count += 1;
            samples.take(
                setup,
                times,
                step,
                #[inline(always)]
                |time| {
                    let t = A::Scalar::from_f64(time);
                    let vectors = setup.sum(a, |k| series[k], &step.start, t);
                    state(vectors.map(|v| v.vector()), t)
                },
            );
            Ok(())
        },
    )?;
    Ok(samples)
}

impl<T> Samples<T> {
    /// No samples yet, with capacity for `count`.
    pub(super) fn with_room(count: usize, order: usize) -> Self {
        Self { states: Vec::with_capacity(count), step_count: 0, order }
    }

    /// Evaluates those of the `times` that lie in a step and have not been evaluated.
    #[inline(always)]
    pub(super) fn take<S: Real, const V: usize>(
        &mut self,
        setup: &ScaledProblem<S, V>,
        times: &[f64],
        step: &Interval,
        state_at: impl Fn(f64) -> T,
    ) {
        while let Some(&time) = times.get(self.states.len()) {
            let elapsed = (time - setup.span.0).abs();
            if elapsed >= step.end {
                break;
            }
            self.states.push(state_at(time));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_in_the_order_in_which_a_motion_reaches_them() {
        assert_eq!(span_of(0.5, &[0.5, 1.0, 1.0, 3.0]), Ok((0.5, 3.0)));
        assert_eq!(span_of(0.5, &[0.5, -1.0, -1.0, -3.0]), Ok((0.5, -3.0)));
        let refused = |start: f64, times: &[f64]| match span_of(start, times) {
            Err(Error::Domain { value, .. }) => value,
            other => panic!("{other:?}"),
        };
        assert_eq!(refused(0.5, &[]), 0.0);
        assert_eq!(refused(0.5, &[2.0, 1.0, 3.0]), 1.0);
        assert_eq!(refused(0.5, &[-2.0, -1.0, -3.0]), -1.0);
        assert_eq!(refused(0.5, &[4.0, 3.0]), 4.0);
        assert_eq!(refused(0.5, &[-4.0, -3.0]), -4.0);
        assert_eq!(refused(0.5, &[0.4, 3.0]), 0.4);
    }
}
