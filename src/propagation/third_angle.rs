//! The third angle without a singularity: `e_x` from a vector that rotates with `L / I^xx` like `n`, and a rotation about `n`
//! at a constant rate.

use nalgebra::Vector3;

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::numerics::scalar::{Real, Scalar};

/// Rate at which `e_x` rotates about `n` relative to a vector that rotates with `L / I^xx` like `n`: `-epsilon Omega^z`,
/// from `Omega = L / I^xx - epsilon Omega^z n`. It is constant, since `Omega^z = L.n / I^zz` is. `n` and `L` are those given, not in another frame: the
/// rounding of `L.n` for an `L` almost normal to `n` is multiplied by `1 / I^zz`, which is large for a needle.
pub(super) fn rate_about_axis<S: Real>(spheroid: &RigidSpheroid<S>, axis: &Vector3<S>, momentum: &Vector3<S>) -> S {
    -(spheroid.oblateness() * S::inner_product(momentum, axis) / spheroid.inertia_zz)
}

/// The state of the body from `n`, `L` and the vector carried along, relative to which `e_x` has rotated about `n` by an
/// angle (rad).
pub(super) fn body_state<S: Scalar>([axis, momentum, companion]: [Vector3<S>; 3], turned: S) -> BodyState<S> {
    let (sin, cos) = turned.sin_cos();
    BodyState { axis, momentum, equatorial_axis: companion * cos + axis.cross(&companion) * sin }
}
