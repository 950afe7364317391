//! Operation counts of a computed motion.

use core::cell::Cell;

use nalgebra::Matrix3;

use crate::dynamics::{AxisState, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::propagation::{Motion, Turning};

/// Work done or planned.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Work {
    /// Steps of a numerical motion.
    pub steps: f64,
    /// Number of right-hand sides: coefficients of series, or stages, of all steps.
    pub right_hand_sides: f64,
    /// Number of evaluations of `(n, L)` alone at a time.
    pub axis_evaluations: f64,
    /// Number of evaluations of `(n, L, e_x)` at a time.
    pub orientation_evaluations: f64,
}

impl Work {
    /// Work for steps by series of an order.
    pub(super) fn of_series(steps: usize, order: usize) -> Self {
        Self { steps: steps as f64, right_hand_sides: (steps * order) as f64, ..Self::default() }
    }

    /// Number of evaluations of either kind.
    pub fn evaluations(&self) -> f64 {
        self.axis_evaluations + self.orientation_evaluations
    }
}

impl core::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.steps += other.steps;
        self.right_hand_sides += other.right_hand_sides;
        self.axis_evaluations += other.axis_evaluations;
        self.orientation_evaluations += other.orientation_evaluations;
    }
}

/// A motion that counts its evaluations.
///
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use twofold::dynamics::{AxisState, Problem, RigidSpheroid};
/// use twofold::plan::{Cost, Counted, Method, State};
/// use twofold::propagation::Motion;
///
/// let start = AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(0.1, 0.2, 1.3) };
/// let problem = Problem::new(RigidSpheroid::in_units_of_tc(1.1), Matrix3::zeros(), start)?;
/// let motion = Counted::new(problem.motion_by(Method::Free, (0.0, 100.0), 1e-12)?);
/// motion.state(42.0)?;
/// assert_eq!(motion.evaluations().axis_evaluations, 1.0);
/// assert!(Cost::of(Method::Free, State::Axis).setup < Cost::of(Method::Taylor, State::Axis).setup);
/// # Ok::<(), twofold::Error>(())
/// ```
#[derive(Debug)]
pub struct Counted<M> {
    /// The motion itself.
    pub motion: M,
    axis: Cell<u64>,
    orientation: Cell<u64>,
}

impl<M> Counted<M> {
    /// Starts counting at zero.
    pub fn new(motion: M) -> Self {
        Self { motion, axis: Cell::new(0), orientation: Cell::new(0) }
    }

    /// Evaluations so far, as [`Work`] without steps.
    pub fn evaluations(&self) -> Work {
        Work {
            axis_evaluations: self.axis.get() as f64,
            orientation_evaluations: self.orientation.get() as f64,
            ..Work::default()
        }
    }

    fn count<X: RotationState<f64>>(&self) {
        let counter = if X::VECTORS == 3 { &self.orientation } else { &self.axis };
        counter.set(counter.get() + 1);
    }
}

/// This type has no projection of its own, so every evaluation of the motion is counted.
impl<M: Motion<f64>> Motion<f64> for Counted<M> {
    type State = M::State;

    fn spheroid(&self) -> &RigidSpheroid<f64> {
        self.motion.spheroid()
    }

    fn coefficients(&self) -> &Matrix3<f64> {
        self.motion.coefficients()
    }

    fn span(&self) -> (f64, f64) {
        self.motion.span()
    }

    fn state(&self, t: f64) -> Result<M::State, Error> {
        self.count::<M::State>();
        self.motion.state(t)
    }

    fn axis_state(&self, t: f64) -> Result<AxisState<f64>, Error> {
        self.count::<AxisState<f64>>();
        self.motion.axis_state(t)
    }

    fn state_in_parts(&self, t: [f64; 2]) -> Result<M::State, Error> {
        self.count::<M::State>();
        self.motion.state_in_parts(t)
    }

    fn axis_state_in_parts(&self, t: [f64; 2]) -> Result<AxisState<f64>, Error> {
        self.count::<AxisState<f64>>();
        self.motion.axis_state_in_parts(t)
    }

    fn error_estimate(&self, t: f64) -> f64 {
        self.motion.error_estimate(t)
    }

    fn turning(&self) -> Turning<'_> {
        self.motion.turning()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_adds_up() {
        let work = |[steps, right_hand_sides, axis_evaluations, orientation_evaluations]: [f64; 4]| Work {
            steps,
            right_hand_sides,
            axis_evaluations,
            orientation_evaluations,
        };
        let mut sum = work([1.0, 20.0, 300.0, 4000.0]);
        sum += work([7.0, 11.0, 13.0, 17.0]);
        assert_eq!(sum, work([8.0, 31.0, 313.0, 4017.0]));
    }
}
