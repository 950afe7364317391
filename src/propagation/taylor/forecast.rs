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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_motion_is_one_step() {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.5, constant_c: 0.8 };
        let violation = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.03));
        let (axis, momentum) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.3, -0.5, 1.2));
        let initial = BodyState { axis, momentum, equatorial_axis: Vector3::y() };
        for (duration, with_equatorial_axis) in [(0.0, true), (1e-3, false), (-1e-3, true)] {
            let forecast = taylor_forecast(&spheroid, &violation, &initial, with_equatorial_axis, duration, 1e-10);
            assert_eq!(forecast.unwrap().steps, 1.0, "{duration}");
        }
    }
}
