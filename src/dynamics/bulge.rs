//! The centrifugal bulge of a star, in addition to its rigid deformation.
//!
//! A star is flattened by its rotation. The bulge follows the angular momentum however the body turns, so it causes no free precession, but it has
//! its own anisotropic self-energy, with `C_f` proportional to the square of the rotation rate:
//!
//! ```text
//! V = C n.(s n) + b L.(s L),    b = C_f / L.L,    s traceless
//! ```
//!
//! For a fluid `C_f` is half of the rotational energy, `b = 1 / (4 I^xx)`. The bulge rotates everything together, the axes of the body and `L`, with
//! the angular velocity `T = 2 b s L`:
//!
//! ```text
//! dn/dt = (L / I^xx + T) x n,    dL/dt = -2 C n x (s n) + T x L,    d e_x/dt = (Omega + T) x e_x
//! ```
//!
//! so it changes neither the angle of `n` to `L` nor `|L|`. An isotropic part of `s` would only change the rate of rotation, as another moment of
//! inertia does; it is left out.
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::bulge::{bulge_potential, bulge_turning, kinematic_momentum};
//! use twofold::dynamics::equations_of_motion::angular_velocity;
//! use twofold::{AxisState, RigidSpheroid};
//!
//! let (s, star) = (Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.03_f64)), RigidSpheroid::in_units_of_tc(1.1));
//! let state = AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(0.3, -0.5, 1.1) };
//! let turning = bulge_turning(0.25, &s, &state.momentum);
//! // The energy is of second degree in L.
//! assert!((turning.dot(&state.momentum) - 2.0 * bulge_potential(0.25, &s, &state.momentum)).abs() < 1e-15);
//! let omega = |momentum: &Vector3<f64>| angular_velocity(&star, &state.axis, momentum);
//! let moving = kinematic_momentum(&star, &s, 0.25, &state);
//! assert!((omega(&moving) - omega(&state.momentum) - turning).amax() < 1e-15);
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{AxisState, RigidSpheroid};
use crate::numerics::scalar::Scalar;

/// `b L.(s L)` with the traceless part of `s`, an energy; `bulge` is `b`, in units of one over a moment of inertia.
pub fn bulge_potential<S: Scalar>(bulge: S, s: &Matrix3<S>, momentum: &Vector3<S>) -> S {
    bulge * momentum.dot(&pulled(s, momentum))
}

/// `T = 2 b s L` with the traceless part of `s`: the angular velocity with which a bulge rotates the axes of the body and
/// `L`.
pub fn bulge_turning<S: Scalar>(bulge: S, s: &Matrix3<S>, momentum: &Vector3<S>) -> Vector3<S> {
    pulled(s, momentum) * (bulge * 2.0)
}

/// `I Omega`, which is `L` without a bulge and `L + I T` with one. Used in place of `L` in the formulas for a rigid star, it gives the angular
/// velocity and the Euler rates of a star with a bulge ([`angular_velocity`](crate::dynamics::equations_of_motion::angular_velocity)).
pub fn kinematic_momentum<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    bulge: S,
    state: &AxisState<S>,
) -> Vector3<S> {
    let turning = bulge_turning(bulge, s, &state.momentum);
    let along = state.axis.dot(&turning) * (spheroid.inertia_zz - spheroid.inertia_xx);
    state.momentum + (turning * spheroid.inertia_xx + state.axis * along)
}

fn pulled<S: Scalar>(s: &Matrix3<S>, momentum: &Vector3<S>) -> Vector3<S> {
    s * momentum - momentum * (s.trace() / 3.0)
}
