//! How fast a direction fixed in the body can turn, at any time of a motion.

use nalgebra::Matrix3;

use crate::dynamics::regular_equations::angular_velocity;
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::scalar::{Real, real_part};

/// Bounds on the first three time derivatives of any unit vector fixed in the body, hence of `m.n`, that hold at all times
/// of the motion through a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateBounds {
    /// Bound on `|dm/dt|`, the largest `|Omega|`.
    pub first: f64,
    /// Bound on `|d2m/dt2|`.
    pub second: f64,
    /// Bound on `|d3m/dt3|`.
    pub third: f64,
}

/// The bounds from one state of the motion, by its energy and spin.
///
/// With `T = |C| (largest - smallest eigenvalue of s) / I^xx`, bounded by the Frobenius norm of its anisotropic part, the
/// torque is at most `I^xx T` and its rate `2 I^xx T |dn/dt|`; the energy keeps `|dn/dt|^2 <= |dn/dt|^2(now) + 2 T = v^2`, and
/// the spin `Omega^z` is constant. Hence, with `w = sqrt(v^2 + Omega^z^2)`, `e = |I^zz - I^xx| |Omega^z| / I^xx` and
/// `g = sqrt(v^2 + (I^zz Omega^z / I^xx)^2) >= |L| / I^xx`,
///
/// ```text
/// |Omega| <= w,   |Omega'| <= a = T + e v,   |Omega''| <= 2 T v + e (T + g v),
/// |m'| <= w,      |m''| <= a + w^2,          |m'''| <= |Omega''| + 3 a w + w^3
/// ```
pub fn rate_bounds<S: Real>(spheroid: &RigidSpheroid<S>, s: &Matrix3<S>, state: &BodyState<S>) -> RateBounds {
    let (xx, zz) = (spheroid.inertia_xx.re(), spheroid.inertia_zz.re());
    let s = s.map(S::re);
    let anisotropic = s - Matrix3::from_diagonal_element(s.trace() / 3.0);
    let torque = spheroid.constant_c.re().abs() * anisotropic.norm() * core::f64::consts::SQRT_2 / xx;
    let omega = real_part(&angular_velocity(spheroid, &state.axis, &state.momentum));
    let axis = real_part(&state.axis);
    let spin = omega.dot(&axis).abs();
    let v = (omega.cross(&axis).norm_squared() + 2.0 * torque).sqrt();
    let w = v.hypot(spin);
    let e = ((zz - xx) / xx).abs() * spin;
    let g = v.hypot(zz / xx * spin);
    let angular_acceleration = torque + e * v;
    let angular_jerk = 2.0 * torque * v + e * (torque + g * v);
    // Unit vectors are such to 1e-9.
    let slack = 1.0 + 1e-7;
    RateBounds {
        first: w * slack,
        second: (angular_acceleration + w * w) * slack,
        third: (angular_jerk + 3.0 * angular_acceleration * w + w * w * w) * slack,
    }
}
