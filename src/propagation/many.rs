//! Many motions, as fast as the processor can.

use nalgebra::Matrix3;

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
#[cfg(target_arch = "x86_64")]
use crate::propagation::registers::Register;
#[cfg(target_arch = "x86_64")]
use crate::propagation::splitting::lanes::{Ready, propagate_in_lanes};
#[cfg(target_arch = "x86_64")]
use crate::propagation::taylor::{axis_states_in_lanes, span_of};
use crate::propagation::{AxisState, ErrorEstimates, Samples, axis_states_at};

/// One of many motions: what [`axis_states_at`] takes.
#[derive(Debug, Clone, Copy)]
pub struct AxisScene<'t> {
    /// The body.
    pub spheroid: RigidSpheroid<f64>,
    /// The tensor `s^IJ` in the frame of the initial state.
    pub violation: Matrix3<f64>,
    /// State at the start.
    pub initial: AxisState<f64>,
    /// Time of the initial state.
    pub start: f64,
    /// Times of the states asked, in the order in which the motion reaches them from its start.
    pub times: &'t [f64],
    /// As for [`propagate`](crate::propagation::propagate).
    pub accuracy: f64,
}

/// States of many motions at the times asked of each: those of [`axis_states_at`] within the accuracy asked, at a fraction of
/// the time where the processor has vectors of doubles (AVX2: 4 motions at once, AVX-512: 8).
///
/// There each motion goes by the splitting scheme that a model of cost and error chooses for it, as in
/// [`propagate_by_best_splitting`](crate::propagation::splitting::propagate_by_best_splitting), and by Taylor series where
/// rounding would spoil that or samples lie close together. Elsewhere all go by Taylor series.
///
/// Errors are not estimated. Each motion has its own steps, and its numbers do not depend on those beside it, on their order or on their number.
///
/// # Errors
/// As for [`axis_states_at`], for each motion on its own.
pub fn axis_states_of_many(scenes: &[AxisScene<'_>]) -> Vec<Result<Samples<AxisState<f64>>, Error>> {
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(register) = pulp::x86::V4::try_new() {
            return in_lanes(register, scenes);
        }
        if let Some(register) = pulp::x86::V3::try_new() {
            return in_lanes(register, scenes);
        }
    }
    let alone = |scene: &AxisScene| {
        let AxisScene { spheroid, violation, initial, start, times, accuracy } = scene;
        axis_states_at(spheroid, violation, initial, *start, times, *accuracy, ErrorEstimates::NotWanted)
    };
    scenes.iter().map(alone).collect()
}

#[cfg(target_arch = "x86_64")]
fn in_lanes<R: Register>(register: R, scenes: &[AxisScene<'_>]) -> Vec<Result<Samples<AxisState<f64>>, Error>> {
    let mut outcomes: Vec<_> = scenes.iter().map(|_| None).collect();
    let (mut split, mut series) = (Vec::new(), Vec::new());
    for (index, scene) in scenes.iter().enumerate() {
        match span_of(scene.start, scene.times).and_then(|_| Ready::new(index, scene)) {
            Ok(Some(ready)) => split.push(ready),
            Ok(None) => series.push(index),
            Err(error) => outcomes[index] = Some(Err(error)),
        }
    }
    propagate_in_lanes(register, split, &mut outcomes);
    let left: Vec<_> = series.iter().map(|&index| scenes[index]).collect();
    for (index, outcome) in series.into_iter().zip(axis_states_in_lanes(register, &left)) {
        outcomes[index] = Some(outcome);
    }
    outcomes.into_iter().map(|outcome| outcome.expect("every motion is split or expanded")).collect()
}
