//! Orientation of the body by Euler angles: the rotation matrix, its rates and their inverses. Eqs. (7)-(9), (22), (36).
//!
//! `alpha` is the precession angle (from X to the line of nodes), `beta` the inclination of the symmetry axis to Z,
//! `gamma` the rotation about the symmetry axis (Landau & Lifshitz, Mechanics, section 35). All in rad.
//!
//! ```
//! use twofold::euler_angles::{
//!     EulerAngles, EulerRates, angles_from_rotation, body_from_inertial, body_rates, euler_rates, permuted_from_inertial,
//!     symmetry_axis, tensor_in_body_frame,
//! };
//!
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! let rotation = body_from_inertial(&angles);
//! // Rows are the body axes.
//! assert!((rotation.row(2).transpose() - symmetry_axis(angles.alpha, angles.beta)).amax() < 1e-16);
//! assert!((angles_from_rotation(&rotation)?.gamma - 0.1).abs() < 1e-15);
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let omega = body_rates(&angles, &rates);
//! assert!((euler_rates(&angles, &omega)?.alpha - 1.4).abs() < 1e-14);
//! // Isotropic tensors are the same in every frame.
//! let isotropic = nalgebra::Matrix3::identity();
//! assert!((tensor_in_body_frame(&rotation, &isotropic) - isotropic).amax() < 1e-15);
//! assert_eq!(permuted_from_inertial::<f64>().determinant(), 1.0);
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::error::Error;
use crate::numerics::scalar::{Real, Scalar};

/// Euler angles of the body frame x-y-z in the inertial frame X-Y-Z (rad).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EulerAngles<S> {
    /// Precession angle, from X to the line of nodes.
    pub alpha: S,
    /// Inclination of the symmetry axis z to Z.
    pub beta: S,
    /// Rotation about the symmetry axis, from the line of nodes to x.
    pub gamma: S,
}

impl<S: Copy> EulerAngles<S> {
    /// The same angles in another number type.
    pub fn map<T>(&self, convert: impl Fn(S) -> T) -> EulerAngles<T> {
        EulerAngles { alpha: convert(self.alpha), beta: convert(self.beta), gamma: convert(self.gamma) }
    }
}

/// Time derivatives of the Euler angles (rad per unit of time).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EulerRates<S> {
    /// Rate of `alpha`.
    pub alpha: S,
    /// Rate of `beta`.
    pub beta: S,
    /// Rate of `gamma`.
    pub gamma: S,
}

impl<S: Copy> EulerRates<S> {
    /// The same rates in another number type.
    pub fn map<T>(&self, convert: impl Fn(S) -> T) -> EulerRates<T> {
        EulerRates { alpha: convert(self.alpha), beta: convert(self.beta), gamma: convert(self.gamma) }
    }
}

/// Rotation matrix `R^{iI} = e_i . e_I`, Eqs. (8) `[rmat]` and (9) `[trans]`: rows are the body axes x, y, z, columns the
/// inertial axes X, Y, Z, so that `v_body = R v_inertial`.
pub fn body_from_inertial<S: Scalar>(angles: &EulerAngles<S>) -> Matrix3<S> {
    let (sa, ca) = angles.alpha.sin_cos();
    let (sb, cb) = angles.beta.sin_cos();
    let (sg, cg) = angles.gamma.sin_cos();
    Matrix3::new(
        ca * cg - sa * cb * sg,
        sa * cg + ca * cb * sg,
        sb * sg,
        -(ca * sg) - sa * cb * cg,
        ca * cb * cg - sa * sg,
        sb * cg,
        sa * sb,
        -(ca * sb),
        cb,
    )
}

/// Symmetry axis `e_z = (sin a sin b, -cos a sin b, cos b)` in inertial components: the last row of Eq. (9) `[trans]`.
pub fn symmetry_axis<S: Scalar>(alpha: S, beta: S) -> Vector3<S> {
    let (sa, ca) = alpha.sin_cos();
    let (sb, cb) = beta.sin_cos();
    Vector3::new(sa * sb, -(ca * sb), cb)
}

/// Body-frame components `s^{ij} = R^{iI} R^{jJ} s^{IJ}` of a tensor given in the inertial frame, Eq. (7).
pub fn tensor_in_body_frame<S: Scalar>(rotation: &Matrix3<S>, inertial: &Matrix3<S>) -> Matrix3<S> {
    rotation * inertial * rotation.transpose()
}

/// Angular velocity in the body frame from the Euler rates, Eq. (22) `[angvel1]`.
///
/// ```text
/// Omega^x = a' sin b sin g + b' cos g,   Omega^y = a' sin b cos g - b' sin g,   Omega^z = a' cos b + g'
/// ```
pub fn body_rates<S: Scalar>(angles: &EulerAngles<S>, rates: &EulerRates<S>) -> Vector3<S> {
    let (sb, cb) = angles.beta.sin_cos();
    let (sg, cg) = angles.gamma.sin_cos();
    Vector3::new(
        rates.alpha * sb * sg + rates.beta * cg,
        rates.alpha * sb * cg - rates.beta * sg,
        rates.alpha * cb + rates.gamma,
    )
}

/// Euler rates from the angular velocity in the body frame: the inverse of Eq. (22) `[angvel1]`.
///
/// # Errors
/// [`Error::Domain`] where `|sin beta|` is not above the rounding of one, 2.2e-16: at the pole the rates of `alpha` and
/// `gamma` are not separately defined. Near it the relative error grows as `1 / |sin beta|`; use the regular state there.
pub fn euler_rates<S: Real>(angles: &EulerAngles<S>, omega_body: &Vector3<S>) -> Result<EulerRates<S>, Error> {
    let (sb, cb) = angles.beta.sin_cos();
    let (sg, cg) = angles.gamma.sin_cos();
    refuse_pole(sb.re())?;
    let alpha = (omega_body.x * sg + omega_body.y * cg) / sb;
    Ok(EulerRates { alpha, beta: omega_body.x * cg - omega_body.y * sg, gamma: omega_body.z - alpha * cb })
}

/// Euler angles of a rotation matrix (rows: body axes), the inverse of Eq. (9) `[trans]`, with `beta` in [0, pi] and
/// `alpha`, `gamma` from -pi to pi.
///
/// `beta` is computed with the two-argument arctangent, so it keeps full precision near the poles.
///
/// # Errors
/// [`Error::Domain`] where the symmetry axis is at a pole (`sin beta` not above 2.2e-16).
pub fn angles_from_rotation<S: Real>(rotation: &Matrix3<S>) -> Result<EulerAngles<S>, Error> {
    let (x, y, z) = (rotation[(2, 0)], rotation[(2, 1)], rotation[(2, 2)]);
    let sin_beta_squared = x * x + y * y;
    refuse_pole(sin_beta_squared.re().sqrt())?;
    Ok(EulerAngles {
        alpha: x.atan2(-y),
        beta: sin_beta_squared.sqrt().atan2(z),
        gamma: rotation[(0, 2)].atan2(rotation[(1, 2)]),
    })
}

/// The matrix that converts components in X-Y-Z to components in the permuted frame Y-Z-X, whose third axis is X: the
/// geometry behind Eq. (36).
///
/// Euler angles of the body in the permuted frame are those of `R P^T`, with `R` from [`body_from_inertial`].
pub fn permuted_from_inertial<S: Scalar>() -> Matrix3<S> {
    let (o, l) = (S::zero(), S::one());
    Matrix3::new(o, l, o, o, o, l, l, o, o)
}

/// Refuses an axis on a pole, where the Euler angles are singular.
pub(crate) fn refuse_pole(sin_beta: f64) -> Result<(), Error> {
    Error::ensure(
        sin_beta.abs() > f64::EPSILON,
        "sine of the inclination, sin beta",
        sin_beta,
        "above 2.2e-16 in size; on the poles alpha and gamma are not defined separately",
    )
}
