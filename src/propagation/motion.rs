//! A motion: the state of rotation at any time of a span, whoever computed it.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::propagation::{SeriesProjection, Turning};
use crate::scalar::Scalar;

/// State of the reduced motion of a spheroid in inertial components: what its potential energy, its spin axis and its
/// gravitational wave depend on. The rotation about the symmetry axis is left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisState<S> {
    /// Symmetry axis `n = e_z`, a unit vector.
    pub axis: Vector3<S>,
    /// Angular momentum `L`.
    pub momentum: Vector3<S>,
}

impl<S: Scalar> AxisState<S> {
    /// The same motion seen from another inertial frame: both vectors multiplied by the rotation `other_from_this`.
    pub fn rotated(&self, other_from_this: &Matrix3<S>) -> Self {
        Self { axis: other_from_this * self.axis, momentum: other_from_this * self.momentum }
    }
}

impl<S: Scalar> From<&BodyState<S>> for AxisState<S> {
    fn from(state: &BodyState<S>) -> Self {
        Self { axis: state.axis, momentum: state.momentum }
    }
}

/// The motion of the symmetry axis and the angular momentum of one spheroid over a span of time. Observables take a motion
/// and never know the method behind it.
pub trait AxisMotion<S: Scalar> {
    /// The body that moves.
    fn spheroid(&self) -> &RigidSpheroid<S>;

    /// The tensor `s^IJ`, in the inertial frame of the states.
    fn violation(&self) -> &Matrix3<S>;

    /// First and last time at which the motion is known, in either order.
    fn span(&self) -> (f64, f64);

    /// Symmetry axis and angular momentum at time `t`. Dense: any `t` of the span, at a cost that does not depend on how far
    /// `t` is from a step.
    ///
    /// # Errors
    /// [`Error::Domain`] for a time outside [`span`](AxisMotion::span).
    fn axis_state(&self, t: S) -> Result<AxisState<S>, Error>;

    /// As [`axis_state`](Self::axis_state), at the time `t[0] + t[1]`: a motion that keeps its phases in 32 digits uses both.
    ///
    /// # Errors
    /// As for [`axis_state`](AxisMotion::axis_state).
    fn axis_state_in_parts(&self, t: [f64; 2]) -> Result<AxisState<S>, Error> {
        self.axis_state(S::from_f64(t[0] + t[1]))
    }

    /// Estimated error of the components of `n` and, where it is known, `e_x`, and of those of `L` in units of its size (that
    /// of `L` at the start and what the torque makes of it), at time `t` of the span.
    fn error_estimate(&self, t: f64) -> f64;
}

/// The whole rotation of one spheroid over a span of time, the angle about the symmetry axis included.
pub trait Motion<S: Scalar>: AxisMotion<S> {
    /// State at time `t`, as dense as [`axis_state`](AxisMotion::axis_state).
    ///
    /// # Errors
    /// [`Error::Domain`] for a time outside [`span`](AxisMotion::span).
    fn state(&self, t: S) -> Result<BodyState<S>, Error>;

    /// As [`state`](Self::state), at the time `t[0] + t[1]`.
    ///
    /// # Errors
    /// As for [`state`](Motion::state).
    fn state_in_parts(&self, t: [f64; 2]) -> Result<BodyState<S>, Error> {
        self.state(S::from_f64(t[0] + t[1]))
    }

    /// What turns the body: [`Turning::Equations`], or the rates of another law with their bounds. A search for pulses misses none if
    /// this is right.
    fn turning(&self) -> Turning<'_>;

    /// What gives the component along a fixed `direction` of a vector fixed in the body (its components there) for less than a
    /// state, if the motion has it: one that is kept as Taylor series in doubles, on a processor with vector instructions.
    fn projection(&self, _in_body: &Vector3<f64>, _direction: &Vector3<f64>) -> Option<SeriesProjection<'_>> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_vectors_turn_with_the_frame() {
        let quarter = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let state = AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(2.0, 3.0, 5.0) };
        let turned = state.rotated(&quarter);
        assert_eq!(turned.axis, Vector3::new(0.0, 0.6, 0.8));
        assert_eq!(turned.momentum, Vector3::new(-3.0, 2.0, 5.0));
    }
}
