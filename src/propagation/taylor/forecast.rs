//! What a numerical motion will take, from its first step.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::propagation::arithmetic::Plain;
use crate::propagation::taylor::setup::Setup;
use crate::propagation::taylor::{fused_for, work_of};

/// What [`propagate`](crate::propagation::propagate) will do, from its first step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaylorForecast {
    /// Order of the series.
    pub order: usize,
    /// Steps, if all are as long as the first; at least one.
    pub steps: f64,
    /// Upper bound of the rate at which directions turn, with which errors grow.
    pub turning_rate: f64,
}

/// What [`propagate`](crate::propagation::propagate), or without `e_x` [`propagate_axis`](crate::propagation::propagate_axis),
/// will do over a `duration`: the work of one step tells it.
///
/// # Errors
/// As for [`propagate`](crate::propagation::propagate), but for the number of steps.
pub fn taylor_forecast(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    initial: &BodyState<f64>,
    with_equatorial_axis: bool,
    duration: f64,
    accuracy: f64,
) -> Result<TaylorForecast, Error> {
    let [n, l, e_x] = [initial.axis, initial.momentum, initial.equatorial_axis];
    if with_equatorial_axis {
        forecast(spheroid, s, [n, l, e_x], duration, accuracy)
    } else {
        forecast(spheroid, s, [n, l], duration, accuracy)
    }
}

fn forecast<const V: usize>(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    start: [Vector3<f64>; V],
    duration: f64,
    accuracy: f64,
) -> Result<TaylorForecast, Error> {
    let setup = Setup::new(work_of(fused_for::<f64>()), spheroid, s, start, (0.0, duration), accuracy)?;
    let steps = (duration.abs() / setup.drive().first_step(Plain::new())).ceil().max(1.0);
    Ok(TaylorForecast { order: setup.order, steps, turning_rate: setup.scale.turning_rate })
}
