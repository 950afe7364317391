//! Many motions, as fast as the processor can.

use nalgebra::Matrix3;

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::propagation::AxisState;
#[cfg(target_arch = "x86_64")]
use crate::propagation::taylor::lanes::axis_states_in_lanes;
use crate::propagation::taylor::samples::{ErrorEstimates, Samples, axis_states_at};

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

/// States of many motions at the times asked of each: the numbers of [`axis_states_at`] up to rounding, at a fraction of
/// the time where the processor has vectors of doubles (AVX2: 4 motions at once, AVX-512: 8).
///
/// Errors are not estimated. Each motion has its own steps, and its numbers do not depend on those beside it, on their order or on their number.
///
/// # Errors
/// As for [`axis_states_at`], for each motion on its own.
pub fn axis_states_of_many(scenes: &[AxisScene<'_>]) -> Vec<Result<Samples<AxisState<f64>>, Error>> {
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(register) = pulp::x86::V4::try_new() {
            return axis_states_in_lanes(register, scenes);
        }
        if let Some(register) = pulp::x86::V3::try_new() {
            return axis_states_in_lanes(register, scenes);
        }
    }
    let alone = |scene: &AxisScene| {
        let AxisScene { spheroid, violation, initial, start, times, accuracy } = scene;
        axis_states_at(spheroid, violation, initial, *start, times, *accuracy, ErrorEstimates::NotWanted)
    };
    scenes.iter().map(alone).collect()
}
