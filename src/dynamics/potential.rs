//! Anisotropic gravitational self-energy as a function of the orientation. Eqs. (6), (11), (17), (21).
//!
//! # Example
//!
//! ```
//! # use nalgebra::{Matrix3, Vector3};
//! # use twofold::dynamics::{BodyState, RigidSpheroid};
//! # use twofold::euler_angles::{EulerAngles, EulerRates};
//! # use twofold::lorentz_violation::PrincipalCoefficients;
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let state = BodyState::from_angles(&star, &angles, &rates);
//! use twofold::dynamics::potential::{
//!     anisotropic_potential, anisotropic_potential_in_angles, anisotropic_potential_of_axis, anisotropic_potential_of_body,
//!     nordtvedt_potential, potential_gradient_in_angles,
//! };
//! use twofold::euler_angles::tensor_in_body_frame;
//!
//! let of_axis = anisotropic_potential_of_axis(star.constant_c, &s.tensor(), &state.axis);
//! let of_angles = anisotropic_potential_in_angles(star.constant_c, &s, angles.alpha, angles.beta);
//! let in_body = tensor_in_body_frame(&state.body_from_inertial(), &s.tensor());
//! assert!((of_axis - of_angles).abs() < 1e-16);
//! assert!((of_axis - anisotropic_potential(star.constant_c, in_body.m33)).abs() < 1e-16);
//! // Of any rigid body: -(1/2) s^ij U^ij.
//! assert!((anisotropic_potential_of_body(&in_body, &Matrix3::identity()) + s.tensor().trace() / 2.0).abs() < 1e-16);
//! let (by_alpha, _) = potential_gradient_in_angles(star.constant_c, &s, angles.alpha, angles.beta);
//! let later = anisotropic_potential_in_angles(star.constant_c, &s, angles.alpha + 1e-6, angles.beta);
//! assert!(((later - of_angles) / 1e-6 - by_alpha).abs() < 1e-6);
//! // Nothing in the preferred frame itself.
//! assert_eq!(nordtvedt_potential(1e-9, 1.0, &Vector3::zeros(), &Vector3::z()), 0.0);
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::scalar::Scalar;

/// `delta U = C s^zz` of a spheroid from the body-frame component `s^zz`, Eq. (11) `[pecorrect2]`.
///
/// The part of the self-energy that does not depend on the orientation, `-(1/2) U^xx tr s`, is left out, as in the paper.
pub fn anisotropic_potential<S: Scalar>(constant_c: S, s_zz_body: S) -> S {
    constant_c * s_zz_body
}

/// `delta U` of a spheroid in the principal frame of `s^IJ`, in Euler angles, Eq. (21) `[anisopot]`:
///
/// ```text
/// delta U = C [ (s^XX sin^2 a + s^YY cos^2 a) sin^2 b + s^ZZ cos^2 b ]
/// ```
pub fn anisotropic_potential_in_angles<S: Scalar>(constant_c: S, s: &PrincipalCoefficients<S>, alpha: S, beta: S) -> S {
    let (sa, ca) = alpha.sin_cos();
    let (sb, cb) = beta.sin_cos();
    constant_c * ((s.xx * sa * sa + s.yy * ca * ca) * sb * sb + s.zz * cb * cb)
}

/// Derivatives `(d delta U / d alpha, d delta U / d beta)` of Eq. (21) `[anisopot]`. That by `gamma` is zero.
pub fn potential_gradient_in_angles<S: Scalar>(
    constant_c: S,
    s: &PrincipalCoefficients<S>,
    alpha: S,
    beta: S,
) -> (S, S) {
    let (sa, ca) = alpha.sin_cos();
    let (sb, cb) = beta.sin_cos();
    let equatorial = s.xx * sa * sa + s.yy * ca * ca;
    (constant_c * s.asymmetry() * sa * ca * sb * sb * 2.0, constant_c * (equatorial - s.zz) * sb * cb * 2.0)
}

/// `delta U = C n . (s n)` of a spheroid with symmetry axis `n` (unit vector) in any inertial frame: Eq. (11)
/// `[pecorrect2]` without angles, regular everywhere.
pub fn anisotropic_potential_of_axis<S: Scalar>(constant_c: S, s: &Matrix3<S>, axis: &Vector3<S>) -> S {
    constant_c * axis.dot(&(s * axis))
}

/// `delta U = -(1/2) s^ij U^ij` of any body, Eq. (6) `[pecorrect1]` with the integral (17): both tensors in the body frame.
///
/// For a spheroid it exceeds Eq. (11) by the constant `-(1/2) U^xx tr s`.
pub fn anisotropic_potential_of_body<S: Scalar>(s_body: &Matrix3<S>, potential_energy_tensor: &Matrix3<S>) -> S {
    -(s_body * potential_energy_tensor).trace() / 2.0
}

/// Nordtvedt's self-energy `delta U_PPN = -(1/2) alpha_2 T_rot (w . Omega/|Omega|)^2` of a fluid star spinning stationarily,
/// Eq. (13) `[ppndeu1]`: `rotation_axis` is the unit vector along the angular velocity, `w` the velocity relative to the
/// preferred frame in units of c.
///
/// With the replacement (5) `[replace]` it is Eq. (11) `[pecorrect2]` for `C = T_rot / 2` and a star that spins about its
/// symmetry axis; for a precessing star the two differ, and Eq. (11) holds.
pub fn nordtvedt_potential<S: Scalar>(
    alpha_2: S,
    rotational_energy: S,
    w: &Vector3<S>,
    rotation_axis: &Vector3<S>,
) -> S {
    let along = w.dot(rotation_axis);
    -(alpha_2 * rotational_energy * along * along / 2.0)
}
