//! Batch integration of many motions with SIMD lanes.

use crate::dynamics::{AxisState, Problem};
use crate::error::Error;
#[cfg(target_arch = "x86_64")]
use crate::numerics::registers::Register;
use crate::propagation::Samples;
#[cfg(target_arch = "x86_64")]
use crate::propagation::splitting::lanes::{Ready, propagate_in_lanes};
#[cfg(target_arch = "x86_64")]
use crate::propagation::taylor::{axis_states_in_lanes, span_of};

/// One of many motions: the input of [`Problem::taylor_states`].
#[derive(Debug, Clone, Copy)]
pub struct SampledProblem<'t> {
    /// The problem (body, tensor and initial state).
    pub problem: Problem<f64, AxisState<f64>>,
    /// Time of the initial state.
    pub start: f64,
    /// Times of the requested states, in the order in which the motion reaches them from its start.
    pub times: &'t [f64],
    /// Error tolerance, as for [`Problem::taylor`].
    pub tolerance: f64,
}

/// States of many motions, each at its requested times. They agree with those of [`Problem::taylor_states`] within the tolerance, and take a
/// fraction of the time if the processor has vectors of doubles (AVX2: 4 motions at once, AVX-512: 8).
///
/// On such a processor each motion is computed with the splitting scheme that a model of cost and error chooses for it, as in
/// [`Problem::splitting`], or by Taylor series if rounding would limit the splitting or samples are close together. Otherwise all are
/// computed by Taylor series. The model holds for about 99 motions in 100; one near the unstable middle axis may miss the tolerance
/// by a factor of ten.
///
/// Errors are not estimated. Each motion has its own steps, and its results do not depend on the motions next to it, on their order or on their
/// number.
///
/// # Errors
/// As for [`Problem::taylor_states`], for each motion on its own.
pub fn states_of_many(motions: &[SampledProblem<'_>]) -> Vec<Result<Samples<AxisState<f64>>, Error>> {
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(register) = pulp::x86::V4::try_new() {
            return in_lanes(register, motions);
        }
        if let Some(register) = pulp::x86::V3::try_new() {
            return in_lanes(register, motions);
        }
    }
    let alone = |SampledProblem { problem, start, times, tolerance }: &SampledProblem| {
        problem.taylor_states(*start, times, *tolerance)
    };
    motions.iter().map(alone).collect()
}

#[cfg(target_arch = "x86_64")]
fn in_lanes<R: Register>(register: R, motions: &[SampledProblem<'_>]) -> Vec<Result<Samples<AxisState<f64>>, Error>> {
    let mut outcomes: Vec<_> = motions.iter().map(|_| None).collect();
    let (mut split, mut series) = (Vec::new(), Vec::new());
    for (index, motion) in motions.iter().enumerate() {
        match span_of(motion.start, motion.times).and_then(|_| Ready::new(index, motion)) {
            Ok(Some(ready)) => split.push(ready),
            Ok(None) => series.push(index),
            Err(error) => outcomes[index] = Some(Err(error)),
        }
    }
    propagate_in_lanes(register, split, &mut outcomes);
    let left: Vec<_> = series.iter().map(|&index| motions[index]).collect();
    for (index, outcome) in series.into_iter().zip(axis_states_in_lanes(register, &left)) {
        outcomes[index] = Some(outcome);
    }
    outcomes.into_iter().map(|outcome| outcome.expect("every motion is split or expanded")).collect()
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;
    use crate::dynamics::fixture::axis_problem;

    #[test]
    fn both_register_widths_give_the_same_bits() {
        let (Some(four), Some(eight)) = (pulp::x86::V3::try_new(), pulp::x86::V4::try_new()) else { return };
        let times = [3.0, 3.0, 40.0, 47.5];
        let motion = |i: usize| {
            let problem = axis_problem([0.02, 0.01, -0.03].map(|value| value * (1.0 + 0.1 * i as f64)));
            SampledProblem { problem, start: 0.0, times: &times, tolerance: 10f64.powi(-3 - (i % 12) as i32) }
        };
        let motions: Vec<_> = (0..31).map(motion).collect();
        assert_eq!(in_lanes(four, &motions), in_lanes(eight, &motions));
    }
}
