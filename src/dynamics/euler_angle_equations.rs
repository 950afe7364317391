//! Equations of motion in Euler angles. Eq. (25).
//!
//! ```
//! use twofold::dynamics::euler_angle_equations::{AxisAngles, euler_angle_accelerations, euler_angle_residuals};
//! use twofold::{PrincipalCoefficients, RigidSpheroid};
//!
//! let (star, s) = (RigidSpheroid::in_units_of_tc(1.1_f64), PrincipalCoefficients::new([0.02, 0.01, -0.04]));
//! let (spin, q) = (1.3, AxisAngles { alpha: 0.3, beta: 0.7, alpha_rate: 1.4, beta_rate: 0.1 });
//! let accelerations = euler_angle_accelerations(&star, &s, spin, &q);
//! let (a, b) = euler_angle_residuals(&star, &s, spin, &q, accelerations);
//! assert!(a.abs() < 1e-14 && b.abs() < 1e-14);
//! ```

use crate::dynamics::RigidSpheroid;
use crate::dynamics::potential::potential_gradient_in_angles;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::scalar::Scalar;

/// Position and velocity of the symmetry axis in the angles of Eq. (25) `[eleq]`, and its acceleration where it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisAngles<S> {
    /// Precession angle `alpha` (rad).
    pub alpha: S,
    /// Inclination `beta` (rad).
    pub beta: S,
    /// Rate of `alpha`.
    pub alpha_rate: S,
    /// Rate of `beta`.
    pub beta_rate: S,
}

/// Residuals (left side minus right side) of the two equations of Eq. (25) `[eleq]`, with `gamma` eliminated by
/// `Omega^z = a' cos b + g'` (`spin`):
///
/// ```text
/// sin^2 b a'' + sin 2b a' b' - (I^zz Omega^z / I^xx) sin b b' = -(1/I^xx) d(delta U)/d alpha
/// b'' - (1/2) sin 2b a'^2    + (I^zz Omega^z / I^xx) sin b a' = -(1/I^xx) d(delta U)/d beta
/// ```
pub fn euler_angle_residuals<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    spin: S,
    q: &AxisAngles<S>,
    (alpha_acceleration, beta_acceleration): (S, S),
) -> (S, S) {
    let (sb, cb) = q.beta.sin_cos();
    let omega = spheroid.free_precession_constant(spin);
    let (by_alpha, by_beta) = potential_gradient_in_angles(spheroid.constant_c, s, q.alpha, q.beta);
    (
        sb * sb * alpha_acceleration + sb * cb * q.alpha_rate * q.beta_rate * 2.0 - omega * sb * q.beta_rate
            + by_alpha / spheroid.inertia_xx,
        beta_acceleration - sb * cb * q.alpha_rate * q.alpha_rate
            + omega * sb * q.alpha_rate
            + by_beta / spheroid.inertia_xx,
    )
}

/// Accelerations `(a'', b'')` from Eq. (25) `[eleq]`.
///
/// Divides by `sin b`: at the poles, where `alpha` is undefined, the result is not finite. The regular equations of
/// [`equations_of_motion`](crate::dynamics::equations_of_motion) have no such points; numerical motion uses them.
pub fn euler_angle_accelerations<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    spin: S,
    q: &AxisAngles<S>,
) -> (S, S) {
    let (sb, cb) = q.beta.sin_cos();
    let (sa, ca) = q.alpha.sin_cos();
    let omega = spheroid.free_precession_constant(spin);
    let (_, by_beta) = potential_gradient_in_angles(spheroid.constant_c, s, q.alpha, q.beta);
    // The force along alpha contains sin^2 b, which cancels exactly against the left side.
    let by_alpha = spheroid.constant_c * s.asymmetry() * sa * ca * 2.0;
    (
        (omega - cb * q.alpha_rate * 2.0) * q.beta_rate / sb - by_alpha / spheroid.inertia_xx,
        (cb * q.alpha_rate - omega) * sb * q.alpha_rate - by_beta / spheroid.inertia_xx,
    )
}
