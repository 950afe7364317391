//! The third angle without a singularity: `e_x` from a vector that rotates with `L / I^xx` like `n`, and a rotation about `n`
//! at a constant rate.

use nalgebra::Vector3;

use crate::dynamics::BodyState;
use crate::numerics::scalar::Scalar;

/// The state of the body from `n`, `L` and the vector carried along, relative to which `e_x` has rotated about `n` by an
/// angle (rad).
pub(super) fn body_state<S: Scalar>([axis, momentum, companion]: [Vector3<S>; 3], turned: S) -> BodyState<S> {
    let (sin, cos) = turned.sin_cos();
    BodyState { axis, momentum, equatorial_axis: companion * cos + axis.cross(&companion) * sin }
}
