//! A motion: the state of rotation at any time of a span, whoever computed it.

use nalgebra::Matrix3;

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::scalar::Scalar;

/// The rotation of one spheroid over a span of time. Observables take a motion and never know the method behind it.
pub trait Motion<S: Scalar> {
    /// The body that moves.
    fn spheroid(&self) -> &RigidSpheroid<S>;

    /// The tensor `s^IJ`, in the inertial frame of the states.
    fn violation(&self) -> &Matrix3<S>;

    /// First and last time at which the motion is known, in either order.
    fn span(&self) -> (f64, f64);

    /// State at time `t`. Dense: any `t` of the span, at a cost that does not depend on how far `t` is from a step.
    ///
    /// # Errors
    /// [`Error::Domain`] for a time outside [`span`](Motion::span).
    fn state(&self, t: S) -> Result<BodyState<S>, Error>;

    /// Estimated error of the components of `n` and `e_x`, and of those of `L` in units of its size (that of `L` at the start
    /// and what the torque makes of it), at time `t` of the span.
    fn error_estimate(&self, t: f64) -> f64;
}
