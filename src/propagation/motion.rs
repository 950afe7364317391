//! A motion: the state of rotation at any time of a span, independent of the method.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{AxisState, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::numerics::scalar::Scalar;
use crate::propagation::{SeriesProjection, Turning};

/// The motion of one spheroid over a span of time. Observables take a motion and do not depend on the method behind it; those that
/// need the orientation require `Motion<f64, State = BodyState<f64>>`.
pub trait Motion<S: Scalar> {
    /// The state that the motion follows: `n` and `L` alone, or `e_x` too.
    type State: RotationState<S>;

    /// The body.
    fn spheroid(&self) -> &RigidSpheroid<S>;

    /// The tensor `s^IJ`, in the inertial frame of the states.
    fn coefficients(&self) -> &Matrix3<S>;

    /// First and last time at which the motion is known, in either order.
    fn span(&self) -> (f64, f64);

    /// State at time `t`. The output is dense: any `t` of the span is possible, at a cost that does not depend on how far
    /// `t` is from a step.
    ///
    /// # Errors
    /// [`Error::Domain`] for a time outside [`span`](Motion::span).
    fn state(&self, t: S) -> Result<Self::State, Error>;

    /// Symmetry axis and angular momentum at time `t`, which may cost less than the whole state.
    ///
    /// # Errors
    /// As for [`state`](Motion::state).
    fn axis_state(&self, t: S) -> Result<AxisState<S>, Error> {
        self.state(t).map(|state| state.axis_state())
    }

    /// As [`state`](Self::state), at the time `t[0] + t[1]`: a motion that keeps its phases to 32 digits uses both.
    ///
    /// # Errors
    /// As for [`state`](Motion::state).
    fn state_in_parts(&self, t: [f64; 2]) -> Result<Self::State, Error> {
        self.state(S::from_f64(t[0] + t[1]))
    }

    /// As [`axis_state`](Self::axis_state), at the time `t[0] + t[1]`.
    ///
    /// # Errors
    /// As for [`state`](Motion::state).
    fn axis_state_in_parts(&self, t: [f64; 2]) -> Result<AxisState<S>, Error> {
        self.axis_state(S::from_f64(t[0] + t[1]))
    }

    /// Estimated error of the components of `n` and, if it is carried, `e_x`, and of those of `L` in units of its size (`L`
    /// at the start plus the contribution of the torque), at time `t` of the span.
    fn error_estimate(&self, t: f64) -> f64;

    /// The law by which the body rotates. It is [`Turning::Equations`] of a rigid spheroid unless a motion overrides it: a star with a bulge does,
    /// and a motion by another law gives its rates with their bounds. A search for pulses misses none if the law is correct.
    fn turning(&self) -> Turning<'_> {
        Turning::Equations { bulge: 0.0 }
    }

    /// A cheaper way than the state, if the motion has one, to compute the component along a fixed `direction` of a vector
    /// fixed in the body (given by its components there).
    fn projection(&self, _in_body: &Vector3<f64>, _direction: &Vector3<f64>) -> Option<SeriesProjection<'_>> {
        None
    }
}
