//! The near-identity transformation between the averaged motion and the motion itself.
//!
//! It is the flow, over unit time, of the generator
//!
//! ```text
//! W = -(C I^xx / (2 G)) [3 c l + n] . s (l x n),    l = L / G,  G = |L|,  c = n.l
//! ```
//!
//! whose bracket with the kinetic energy removes the part of the potential that depends on the fast angle: `{W, L.L / (2 I^xx)} = V - <V>`. It is
//! regular at `c = 1`. A function `F` of `n` and `L` changes them by `dn = F_L x n`, `dL = F_L x L + F_n x n`, and every other axis of the body
//! by `F_L`.

use nalgebra::Vector3;

use crate::dynamics::RigidSpheroid;

use crate::numerics::scalar::{Real, length};

/// Symmetry axis, angular momentum and an equatorial axis of the body.
pub(super) type Axes<S> = [Vector3<S>; 3];

/// The generator `W`, an action, for `axis` and `momentum` in the principal frame of the tensor with the principal values `s`.
pub fn generator<S: Real>(spheroid: &RigidSpheroid<S>, s: &Vector3<S>, axis: &Vector3<S>, momentum: &Vector3<S>) -> S {
    let size = length(momentum);
    let l = momentum / size;
    let along = l * (axis.dot(&l) * 3.0) + axis;
    -(spheroid.constant_c * spheroid.inertia_xx / size) * along.dot(&s.component_mul(&l.cross(axis))) * 0.5
}

/// `W_n` and `W_L`, the slopes of the [`generator`] with respect to `n` and `L`.
pub fn generator_slopes<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &Vector3<S>,
    axis: &Vector3<S>,
    momentum: &Vector3<S>,
) -> [Vector3<S>; 2] {
    slopes(spheroid.constant_c * spheroid.inertia_xx, s, &[*axis, *momentum, *axis])
}

/// `W_n` and `W_L`, for `strength = C I^xx` and a diagonal `s`.
fn slopes<S: Real>(strength: S, s: &Vector3<S>, [n, momentum, _]: &Axes<S>) -> [Vector3<S>; 2] {
    let size = length(momentum);
    let l = momentum / size;
    let c = n.dot(&l);
    let across = l.cross(n);
    let along = l * (c * 3.0) + n;
    let (pulled, pulled_along) = (s.component_mul(&across), s.component_mul(&along));
    let factor = -(strength / size) * 0.5;
    let share = l.dot(&pulled) * 3.0;
    let by_axis = (l * share + pulled + pulled_along.cross(&l)) * factor;
    let by_direction = (n * share + pulled * (c * 3.0) + n.cross(&pulled_along)) * factor;
    let value = along.dot(&pulled) * factor;
    let by_momentum = (by_direction - l * (l.dot(&by_direction) + value)) / size;
    [by_axis, by_momentum]
}

fn rates<S: Real>(strength: S, s: &Vector3<S>, axes: &Axes<S>) -> Axes<S> {
    let [by_axis, by_momentum] = slopes(strength, s, axes);
    let [n, momentum, equatorial] = axes;
    [by_momentum.cross(n), by_momentum.cross(momentum) + by_axis.cross(n), by_momentum.cross(equatorial)]
}

/// Change of the axes under the flow of `W`, for the `time` 1 from mean to osculating axes, for -1 back. It is one step of the midpoint rule,
/// whose error is of third order in `s`.
pub(super) fn transformation<S: Real>(strength: S, s: &Vector3<S>, axes: &Axes<S>, time: f64) -> Axes<S> {
    let half = rates(strength, s, axes);
    let middle = core::array::from_fn(|i| axes[i] + half[i] * S::from_f64(0.5 * time));
    rates(strength, s, &middle).map(|rate| rate * S::from_f64(time))
}
