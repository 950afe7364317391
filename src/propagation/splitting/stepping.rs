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
