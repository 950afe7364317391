//! Torque of the anisotropic self-energy. Eq. (66).
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
//! use twofold::dynamics::potential::potential_gradient_in_angles;
//! use twofold::dynamics::torque::{torque_from_gradient, torque_from_gradient_off_pole, torque_on_body};
//! use twofold::euler_angles::tensor_in_body_frame;
//!
//! let (by_alpha, by_beta) = potential_gradient_in_angles(star.constant_c, &s, angles.alpha, angles.beta);
//! let gradient = Vector3::new(by_alpha, by_beta, 0.0);
//! let torque = torque_from_gradient(&angles, &gradient)?;
//! assert_eq!(torque, torque_from_gradient_off_pole(&angles, &gradient));
//! assert!(torque_from_gradient(&EulerAngles { beta: 0.0, ..angles }, &gradient).is_err());
//! // From the tensor U^ij in the body, whose difference U^zz - U^xx is -2 C.
//! let in_body = tensor_in_body_frame(&state.body_from_inertial(), &s.tensor());
//! let energies = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, -2.0 * star.constant_c));
//! assert!((torque_on_body(&in_body, &energies) - torque).amax() < 1e-15);
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::error::Error;
use crate::euler_angles::{EulerAngles, refuse_pole};
use crate::numerics::scalar::{Real, Scalar};

/// Body-frame torque from the derivatives of any potential by the Euler angles, Eq. (66):
///
/// ```text
/// Gamma^x = -(sin g / sin b) U_a - cos g U_b + cot b sin g U_g
/// Gamma^y = -(cos g / sin b) U_a + sin g U_b + cot b cos g U_g
/// Gamma^z = -U_g
/// ```
///
/// `gradient` is `(U_a, U_b, U_g)`, the derivatives by `alpha`, `beta`, `gamma`. Divides by `sin b`; the guarded form is
/// [`torque_from_gradient`].
pub fn torque_from_gradient_off_pole<S: Scalar>(angles: &EulerAngles<S>, gradient: &Vector3<S>) -> Vector3<S> {
    let (sb, cb) = angles.beta.sin_cos();
    let (sg, cg) = angles.gamma.sin_cos();
    let across = (gradient.z * cb - gradient.x) / sb;
    Vector3::new(across * sg - gradient.y * cg, across * cg + gradient.y * sg, -gradient.z)
}

/// Body-frame torque from the derivatives of any potential by the Euler angles, Eq. (66).
///
/// # Errors
/// [`Error::Domain`] where `|sin beta|` is not above 2.2e-16. Near the pole the relative error grows as `1 / |sin beta|`;
/// [`torque_on_body`] is regular.
pub fn torque_from_gradient<S: Real>(angles: &EulerAngles<S>, gradient: &Vector3<S>) -> Result<Vector3<S>, Error> {
    let (sb, _) = angles.beta.sin_cos();
    refuse_pole(sb.re())?;
    Ok(torque_from_gradient_off_pole(angles, gradient))
}

/// Torque on any body by its anisotropic self-energy `-(1/2) s^ij U^ij`, without coordinates:
/// `Gamma^i = -epsilon^{ijk} (s U)^{jk}`, all in one frame (body or inertial), three distinct entries of `U^ij` allowed.
///
/// For a spheroid it is `-2 C n x (s n)`.
pub fn torque_on_body<S: Scalar>(s: &Matrix3<S>, potential_energy_tensor: &Matrix3<S>) -> Vector3<S> {
    let p = s * potential_energy_tensor;
    Vector3::new(p[(2, 1)] - p[(1, 2)], p[(0, 2)] - p[(2, 0)], p[(1, 0)] - p[(0, 1)])
}
