//! Steps without storage, for runs of any length.

use crate::dynamics::{AxisState, Problem, RotationState};
use crate::error::Error;
use crate::propagation::TOLERANCE_RANGE;
use crate::propagation::input::check_request;
use crate::propagation::splitting::double_steps::DoubleSteps;
use crate::propagation::splitting::flows::Moving;
use crate::propagation::splitting::motion::PrincipalProblem;
use crate::propagation::splitting::scheme::Scheme;

/// A motion of `n` and `L` that stores only its current state: equal steps of one scheme, without allocation.
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
    /// The current state, open: see `Steps`.
    state: Moving<f64>,
}

impl Splitting {
    /// Starts from the initial state of a problem; a negative step goes backwards in time.
    ///
    /// # Errors
    /// As for [`Problem::splitting_by`], and for a step that is zero or not finite.
    pub fn new<X: RotationState<f64>>(problem: &Problem<f64, X>, scheme: &Scheme, step: f64) -> Result<Self, Error> {
        check_request((0.0, step), TOLERANCE_RANGE.0)?;
        Error::ensure(step != 0.0, "step", step, "nonzero")?;
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
    use super::*;
    use crate::dynamics::fixture::axis_problem;
    use crate::propagation::splitting::STRANG;

    #[test]
    fn a_step_is_finite_and_not_zero() {
        for step in [0.0, f64::INFINITY, f64::NAN] {
            assert!(Splitting::new(&axis_problem([0.0; 3]), &STRANG, step).is_err(), "{step}");
        }
    }
}
