//! Torque of the anisotropic self-energy. Eq. (66).
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::potential::potential_gradient_in_angles;
//! use twofold::dynamics::torque::{torque_from_gradient, torque_on_body};
//! use twofold::euler_angles::{EulerAngles, body_from_inertial, tensor_in_body_frame};
//!
//! let (c, s) = (1.0, twofold::PrincipalCoefficients::new([0.02, 0.01, -0.04]));
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! let (by_alpha, by_beta) = potential_gradient_in_angles(c, &s, angles.alpha, angles.beta);
//! let torque = torque_from_gradient(&angles, &Vector3::new(by_alpha, by_beta, 0.0));
//! // From the tensor U^ij in the body, with U^zz - U^xx = -2 C.
//! let energies = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, -2.0 * c));
//! let in_body = tensor_in_body_frame(&body_from_inertial(&angles), &s.tensor());
//! assert!((torque_on_body(&in_body, &energies) - torque).amax() < 1e-15);
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::euler_angles::EulerAngles;
use crate::numerics::scalar::Scalar;

/// Body-frame torque from the derivatives of any potential with respect to the Euler angles, Eq. (66):
///
/// ```text
/// Gamma^x = -(sin g / sin b) U_a - cos g U_b + cot b sin g U_g
/// Gamma^y = -(cos g / sin b) U_a + sin g U_b + cot b cos g U_g
/// Gamma^z = -U_g
/// ```
///
/// `gradient` is `(U_a, U_b, U_g)`, the derivatives with respect to `alpha`, `beta`, `gamma`. Divides by `sin b`: not finite
/// at the poles, and near them the relative error grows as `1 / |sin b|`; [`torque_on_body`] is regular.
pub fn torque_from_gradient<S: Scalar>(angles: &EulerAngles<S>, gradient: &Vector3<S>) -> Vector3<S> {
    let (sb, cb) = angles.beta.sin_cos();
    let (sg, cg) = angles.gamma.sin_cos();
    let across = (gradient.z * cb - gradient.x) / sb;
    Vector3::new(across * sg - gradient.y * cg, across * cg + gradient.y * sg, -gradient.z)
}

/// Torque on any body from its anisotropic self-energy `-(1/2) s^ij U^ij`, coordinate-free:
/// `Gamma^i = -epsilon^{ijk} (s U)^{jk}`, with both tensors in one frame (body or inertial). The three eigenvalues of `U^ij`
/// may differ.
///
/// For a spheroid it is `-2 C n x (s n)`.
pub fn torque_on_body<S: Scalar>(s: &Matrix3<S>, potential_energy_tensor: &Matrix3<S>) -> Vector3<S> {
    let p = s * potential_energy_tensor;
    Vector3::new(p[(2, 1)] - p[(1, 2)], p[(0, 2)] - p[(2, 0)], p[(1, 0)] - p[(0, 1)])
}
