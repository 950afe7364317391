//! The third angle without a singularity: `e_x` from a vector that rotates with `L / I^xx` like `n`, and a rotation about `n`
//! at a constant rate.

use nalgebra::Vector3;

use crate::dynamics::BodyState;
use crate::numerics::scalar::Scalar;
use crate::solutions::free::normal_turned_about;

/// The state of the body from `n`, `L` and the vector carried along, relative to which `e_x` has rotated about `n` by an
/// angle (rad).
pub(super) fn body_state<S: Scalar>([axis, momentum, companion]: [Vector3<S>; 3], turned: S) -> BodyState<S> {
    BodyState { axis, momentum, equatorial_axis: normal_turned_about(&axis, &companion, turned) }
}
