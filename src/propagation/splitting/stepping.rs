//! Steps without a record, for runs of any length.

use crate::dynamics::{AxisState, Problem, RotationState};
use crate::error::Error;
use crate::propagation::TOLERANCE_RANGE;
use crate::propagation::input::check_request;
use crate::propagation::splitting::double_steps::DoubleSteps;
use crate::propagation::splitting::flows::Moving;
use crate::propagation::splitting::motion::PrincipalProblem;
use crate::propagation::splitting::scheme::Scheme;

/// A motion of `n` and `L` that keeps its present state only: equal steps of one scheme, without allocation.
///
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use twofold::dynamics::{AxisState, Problem, RigidSpheroid};
/// use twofold::propagation::splitting::{GRADIENT_8_6_6, Splitting};
///
/// let start = AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(0.1, 0.2, 1.3) };
/// let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.04));
/// let problem = Problem::new(RigidSpheroid::in_units_of_tc(1.1), s, start).unwrap();
/// let mut motion = Splitting::new(&problem, &GRADIENT_8_6_6, 0.5).unwrap();
/// motion.advance(100_000);
/// assert!((motion.state().axis.norm() - 1.0).abs() < 1e-14);
/// ```
#[derive(Debug, Clone)]
pub struct Splitting {
    scene: PrincipalProblem,
    steps: DoubleSteps,
    /// Open.
    state: Moving<f64>,
}

impl Splitting {
    /// From the initial state of a problem; a step below zero goes backwards in time.
    ///
    /// # Errors
    /// As for [`Problem::splitting_by`], and for a step that is zero or not finite.
    pub fn new<X: RotationState<f64>>(problem: &Problem<f64, X>, scheme: &Scheme, step: f64) -> Result<Self, Error> {
        check_request((0.0, step), TOLERANCE_RANGE.0)?;
        Error::ensure(step != 0.0, "step", step, "not zero")?;
        let scene = PrincipalProblem::new(problem)?;
        let steps = DoubleSteps::new(scheme, &scene.field, step, scene.largest_rate);
        let mut state = scene.start;
        steps.open(&mut state);
        Ok(Self { scene, steps, state })
    }

    /// Takes a number of steps.
    pub fn advance(&mut self, steps: u64) {
        self.steps.advance(&mut self.state, self.scene.casimir, steps);
    }

    /// The state after the steps taken so far.
    pub fn state(&self) -> AxisState<f64> {
        let mut closed = self.state;
        self.steps.close(&mut closed);
        self.scene.state(&closed)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::dynamics::RigidSpheroid;
    use crate::propagation::Motion;
    use crate::propagation::splitting::STRANG;
    use nalgebra::Matrix3;

    #[test]
    fn steps_without_a_record_are_those_of_the_motion_that_is_kept() {
        let star = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.1, constant_c: 0.7 };
        let s = Matrix3::from_diagonal(&Vector3::new(0.3, 0.1, -0.4));
        let start = AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(0.3, -0.7, 1.1) };
        let problem = Problem::new(star, s, start).unwrap();
        let steps = |step| Splitting::new(&problem, &STRANG, step);
        for step in [0.0, f64::INFINITY, f64::NAN] {
            assert!(steps(step).is_err(), "{step}");
        }
        for step in [1.0, -0.25] {
            let mut steps = steps(step).unwrap();
            let kept = problem.splitting_by(&STRANG, (0.0, 8.0 * step), step.abs()).unwrap();
            steps.advance(3);
            steps.advance(2);
            let (found, expected) = (steps.state(), kept.axis_state(5.0 * step).unwrap());
            assert!((found.axis - expected.axis).amax() < 1e-14 && (found.momentum - expected.momentum).amax() < 1e-14);
        }
    }
}
