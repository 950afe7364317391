//! Anisotropic gravitational self-energy as a function of the orientation. Eqs. (6), (11), (13), (17), (21).
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::potential::{
//!     anisotropic_potential_in_angles, anisotropic_potential_of_axis, anisotropic_potential_of_body,
//!     nordtvedt_potential, potential_gradient_in_angles,
//! };
//! use twofold::{PrincipalCoefficients, euler_angles::symmetry_axis};
//!
//! let (c, s, alpha, beta) = (1.0, PrincipalCoefficients::new([0.02, 0.01, -0.04]), 0.3, 0.7_f64);
//! let energy = anisotropic_potential_in_angles(c, &s, alpha, beta);
//! assert!((anisotropic_potential_of_axis(c, &s.tensor(), &symmetry_axis(alpha, beta)) - energy).abs() < 1e-16);
//! let later = anisotropic_potential_in_angles(c, &s, alpha + 1e-6, beta);
//! assert!(((later - energy) / 1e-6 - potential_gradient_in_angles(c, &s, alpha, beta).0).abs() < 1e-6);
//! // With the symmetry axis along Z, where U^ij = diag(0, 0, -2 C) gives the same.
//! let tensor = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, -2.0 * c));
//! assert_eq!(anisotropic_potential_of_body(&s.tensor(), &tensor), c * s.zz);
//! assert_eq!(nordtvedt_potential(1e-9, 2.0 * c, &Vector3::zeros(), &Vector3::z()), 0.0); // at rest in the preferred frame
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::scalar::Scalar;

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

/// Derivatives `(d delta U / d alpha, d delta U / d beta)` of Eq. (21) `[anisopot]`. The derivative with respect to `gamma`
/// is zero.
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

/// `delta U = C s^zz = C n . (s n)` of a spheroid with symmetry axis `n` (unit vector) in any frame: Eq. (11) `[pecorrect2]`, regular
/// everywhere.
///
/// The part of the self-energy that does not depend on the orientation, `-(1/2) U^xx tr s`, is left out, as in the paper.
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
/// symmetry axis. For a precessing star the two differ, and Eq. (11) is the correct one.
pub fn nordtvedt_potential<S: Scalar>(
    alpha_2: S,
    rotational_energy: S,
    w: &Vector3<S>,
    rotation_axis: &Vector3<S>,
) -> S {
    let along = w.dot(rotation_axis);
    -(alpha_2 * rotational_energy * along * along / 2.0)
}
