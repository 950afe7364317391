//! Steps without a record, for runs of any length.

use nalgebra::Matrix3;

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::propagation::input::check_input;
use crate::propagation::splitting::flows::Moving;
use crate::propagation::splitting::motion::{Scene, vectors_of_axis};
use crate::propagation::splitting::one_motion::OneMotion;
use crate::propagation::splitting::scheme::Scheme;
use crate::propagation::{ACCURACY_RANGE, AxisState};

/// A motion of `n` and `L` that keeps its present state only: equal steps of one scheme, without allocation.
///
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use twofold::dynamics::RigidSpheroid;
/// use twofold::propagation::AxisState;
/// use twofold::propagation::splitting::{GRADIENT_8_6_6, Splitting};
///
/// let start = AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(0.1, 0.2, 1.3) };
/// let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.04));
/// let body = RigidSpheroid::in_units_of_tc(1.1);
/// let mut motion = Splitting::new(&body, &s, &start, &GRADIENT_8_6_6, 0.5).unwrap();
/// motion.advance(100_000);
/// assert!((motion.state().axis.norm() - 1.0).abs() < 1e-14);
/// ```
#[derive(Debug, Clone)]
pub struct Splitting {
    scene: Scene,
    steps: OneMotion,
    /// Open.
    state: Moving<f64>,
}

impl Splitting {
    /// From the state `initial`; a step below zero goes backwards in time.
    ///
    /// # Errors
    /// As for [`propagate_by_splitting`](crate::propagation::splitting::propagate_by_splitting), and for a step that is zero or
    /// not finite.
    pub fn new(
        spheroid: &RigidSpheroid<f64>,
        s: &Matrix3<f64>,
        initial: &AxisState<f64>,
        scheme: &Scheme,
        step: f64,
    ) -> Result<Self, Error> {
        let initial = vectors_of_axis(initial);
        check_input(spheroid, s, &initial, (0.0, step), ACCURACY_RANGE.0)?;
        Error::unless(step != 0.0, "step", step, "not zero")?;
        let scene = Scene::new(spheroid, s, &initial)?;
        let steps = OneMotion::new(scheme, &scene.field, step, scene.largest_rate);
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
    use crate::propagation::AxisMotion;
    use crate::propagation::splitting::{STRANG, propagate_by_splitting};

    #[test]
    fn steps_without_a_record_are_those_of_the_motion_that_is_kept() {
        let star = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.1, constant_c: 0.7 };
        let s = Matrix3::from_diagonal(&Vector3::new(0.3, 0.1, -0.4));
        let start = AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(0.3, -0.7, 1.1) };
        let steps = |step| Splitting::new(&star, &s, &start, &STRANG, step);
        for step in [0.0, f64::INFINITY, f64::NAN] {
            assert!(steps(step).is_err(), "{step}");
        }
        for step in [1.0, -0.25] {
            let mut steps = steps(step).unwrap();
            let kept = propagate_by_splitting(&star, &s, &start, (0.0, 8.0 * step), &STRANG, step.abs()).unwrap();
            steps.advance(3);
            steps.advance(2);
            let (found, expected) = (steps.state(), kept.axis_state(5.0 * step).unwrap());
            assert!((found.axis - expected.axis).amax() < 1e-14 && (found.momentum - expected.momentum).amax() < 1e-14);
        }
    }
}
