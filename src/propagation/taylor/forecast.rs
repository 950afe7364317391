//! Predicted cost of a numerical motion, from its first step.

use crate::dynamics::{Problem, RotationState};
use crate::error::Error;
use crate::numerics::arithmetic::plain;
use crate::propagation::taylor::error_growth::{ErrorGrowth, READING};
use crate::propagation::taylor::errors::ROUNDING;
use crate::propagation::taylor::scaled_problem::ScaledProblem;
use crate::propagation::taylor::series::COMPANION;
use crate::propagation::taylor::{fused_for, work_of};

/// Prediction for [`Problem::taylor`], from its first step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaylorForecast {
    /// Order of the series.
    pub order: usize,
    /// Number of steps, if all are as long as the first; at least one.
    pub steps: f64,
    /// The rounding error that [`error_estimate`](crate::propagation::Motion::error_estimate) will report at the end, as far as the
    /// start determines it: for equal steps, the largest possible torque, and constants each rounded by half a unit in the last place of
    /// a rate. It does not include the growth near the unstable middle axis.
    pub rounding: f64,
}

impl<X: RotationState<f64>> Problem<f64, X> {
    /// Predicted cost and rounding of [`taylor`](Self::taylor) over a `duration`, from the work of one step.
    ///
    /// # Errors
    /// As for [`taylor`](Self::taylor), except that the number of steps is not limited.
    pub fn taylor_forecast(&self, duration: f64, tolerance: f64) -> Result<TaylorForecast, Error> {
        if const { X::VECTORS == 3 } {
            forecast::<X, 3>(self, duration, tolerance)
        } else {
            forecast::<X, 2>(self, duration, tolerance)
        }
    }
}

fn forecast<X: RotationState<f64>, const V: usize>(
    problem: &Problem<f64, X>,
    duration: f64,
    tolerance: f64,
) -> Result<TaylorForecast, Error> {
    let setup = ScaledProblem::<_, V>::new(work_of(fused_for::<f64>()), problem, (0.0, duration), tolerance)?;
    let spheroid = problem.spheroid();
    let steps = (duration.abs() / setup.drive().first_step(plain())).ceil().max(1.0);
    let scale = &setup.scale;
    let pull = 2.0 * (spheroid.constant_c / spheroid.inertia_xx).abs() * setup.frame.tensor.norm();
    let strength = if scale.turning_rate > 0.0 { pull / scale.turning_rate.powi(2) } else { 0.0 };
    let rounding = expected_rounding(scale.turning_rate * duration.abs(), steps, strength, V);
    Ok(TaylorForecast { order: setup.order, steps, rounding })
}

/// Prediction of [`ErrorGrowth`] for the rounding of equal `steps`, over a rotation by the angle `turn` with `vectors`
/// carried.
///
/// Each step rounds the rotation, `q = turn / steps`, and the momentum, `strength q`, with deviations of half a unit in the last place. A
/// difference of directions changes the torque, so that it grows as `1 + strength x` over a rotation by `x`; a difference of the momentum
/// along itself grows as `x`. The sum over evenly spaced steps is the integral over `x`. The rounding that all steps share is proportional
/// to the rotation.
fn expected_rounding(turn: f64, steps: f64, strength: f64, vectors: usize) -> f64 {
    let deviation = ROUNDING * f64::EPSILON * turn / steps;
    let pulled = strength * turn;
    let of_torque = 1.0 + pulled + pulled * pulled / 3.0;
    // Rotation, lengths and cosines of the vectors carried; without a carried vector a rotation about the axis does not
    // count.
    let directions = if vectors > COMPANION { 6.0 } else { 3.0 };
    let variance = (directions + 3.0 * strength * strength) * of_torque + pulled * pulled / 3.0;
    let shared = ErrorGrowth::counted(ROUNDING * f64::EPSILON * turn);
    let rounding = READING + shared + ErrorGrowth::counted_deviation(deviation * (steps * variance).sqrt());
    // If squares overflow no digit of the state is left.
    if rounding.is_nan() { f64::INFINITY } else { rounding }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::dynamics::AxisState;
    use crate::dynamics::fixture::{ANGLES, STAR, problem, tensor};
    use crate::euler_angles::EulerRates;

    #[test]
    fn a_motion_without_end_has_no_digits() {
        assert_eq!(expected_rounding(1e308, 1e308, 0.1, 2), f64::INFINITY);
        assert_eq!(expected_rounding(1e308, f64::INFINITY, 0.1, 2), f64::INFINITY);
        assert!(expected_rounding(1e100, 1e100, 0.1, 2).is_finite());
    }

    #[test]
    fn a_star_at_rest_rounds_nothing_but_what_is_read() {
        let rest = EulerRates { alpha: 0.0, beta: 0.0, gamma: 0.0 };
        let problem = Problem::from_angles(STAR, tensor([0.0; 3]), &ANGLES, &rest).unwrap();
        let found = problem.taylor_forecast(1e3, 1e-10).unwrap();
        assert_eq!((found.steps, found.rounding), (1.0, READING));
    }

    /// At rest on an unstable axis of `s`, where all terms of the series vanish, steps are as long as a growing deviation allows, here `e^80` of it.
    /// The motion takes as many steps as predicted.
    #[test]
    fn a_star_at_rest_that_may_leave_takes_the_steps_predicted() {
        let rest = AxisState { axis: Vector3::x(), momentum: Vector3::zeros() };
        let problem = Problem::new(STAR, tensor([0.3, 0.0, -0.3]), rest).unwrap();
        let taken = problem.taylor((0.0, 100.0), 1e-10).unwrap().step_count;
        assert!(taken > 1);
        assert_eq!(problem.taylor_forecast(100.0, 1e-10).unwrap().steps, taken as f64);
    }

    #[test]
    fn a_short_motion_is_one_step() {
        let problem = problem([0.02, 0.01, -0.03]);
        for duration in [0.0, 1e-3, -1e-3] {
            assert_eq!(problem.taylor_forecast(duration, 1e-10).unwrap().steps, 1.0, "{duration}");
            assert_eq!(problem.reduced().taylor_forecast(duration, 1e-10).unwrap().steps, 1.0, "{duration}");
        }
    }
}
