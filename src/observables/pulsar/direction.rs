//! Colatitude and azimuth of the magnetic axis in the inertial frame. Eqs. (49), (50), (54).
//!
//! ```
//! use twofold::EulerAngles;
//! use twofold::observables::pulsar::direction::{
//!     axis_along_line_of_sight_in_azimuth, azimuth_offset_point, cosine_of_colatitude, magnetic_axis_direction,
//! };
//!
//! let (angles, chi, delta) = (EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 }, 0.5, 0.2);
//! let (theta, phi) = magnetic_axis_direction(&angles, chi, delta)?;
//! assert!((cosine_of_colatitude(angles.beta, angles.gamma, chi, delta) - theta.cos()).abs() < 1e-15);
//! let (x, y) = azimuth_offset_point(angles.beta, angles.gamma, chi, delta);
//! assert!((x.hypot(y) - theta.sin()).abs() < 1e-15 && (y.atan2(x) + angles.alpha - phi).sin().abs() < 1e-14);
//! assert!((axis_along_line_of_sight_in_azimuth(theta, phi, theta, phi) - 1.0).abs() < 1e-15); // seen along itself
//! # Ok::<(), twofold::Error>(())
//! ```

use crate::error::Error;
use crate::euler_angles::EulerAngles;
use crate::numerics::scalar::{Real, Scalar};
use crate::observables::sin_cos_of_sum;

/// `cos Theta = cos b cos chi + sin b sin chi sin(g + delta)` of the magnetic axis, Eq. (49) `[tranang]`.
pub fn cosine_of_colatitude<S: Scalar>(beta: S, gamma: S, chi: S, delta: S) -> S {
    let (sin_g, _) = sin_cos_of_sum(gamma, delta);
    let ((sb, cb), (s_chi, c_chi)) = (beta.sin_cos(), chi.sin_cos());
    cb * c_chi + sb * s_chi * sin_g
}

/// The point `(x, y)` of length `sin Theta` at the angle `DeltaPhi = Phi - alpha`, Eq. (50) with numerator and denominator
/// multiplied by `sin chi`, so that it is regular at `chi = 0`:
///
/// ```text
/// x = sin chi cos(g + delta),   y = sin chi cos b sin(g + delta) - cos chi sin b
/// ```
pub fn azimuth_offset_point<S: Scalar>(beta: S, gamma: S, chi: S, delta: S) -> (S, S) {
    let (sin_g, cos_g) = sin_cos_of_sum(gamma, delta);
    let ((sb, cb), (s_chi, c_chi)) = (beta.sin_cos(), chi.sin_cos());
    (s_chi * cos_g, s_chi * cb * sin_g - c_chi * sb)
}

/// Colatitude `Theta` in [0, pi] and azimuth `Phi = alpha + DeltaPhi` of the magnetic axis (rad), Eqs. (49) `[tranang]`,
/// (50).
///
/// `DeltaPhi`, from -pi to pi, is computed with the two-argument arctangent: the printed tangent leaves half a turn open.
/// `Theta` keeps full precision near the poles.
///
/// # Errors
/// [`Error::Domain`] where the magnetic axis is on the Z axis (`sin Theta` not above 2.2e-16): it has no azimuth.
pub fn magnetic_axis_direction<S: Real>(angles: &EulerAngles<S>, chi: S, delta: S) -> Result<(S, S), Error> {
    let (x, y) = azimuth_offset_point(angles.beta, angles.gamma, chi, delta);
    let squared = x * x + y * y;
    refuse_pole(squared.re())?;
    let cosine = cosine_of_colatitude(angles.beta, angles.gamma, chi, delta);
    Ok((squared.sqrt().atan2(cosine), angles.alpha + y.atan2(x)))
}

/// `m.n = sin Theta sin theta_o cos(Phi - phi_o) + cos Theta cos theta_o`, Eq. (54) `[mninertial]`, of the magnetic axis at
/// `(Theta, Phi)` and the observer at `(theta_o, phi_o)`.
pub fn axis_along_line_of_sight_in_azimuth<S: Scalar>(theta: S, phi: S, theta_o: S, phi_o: S) -> S {
    let (_, cos_phi) = sin_cos_of_sum(phi, -phi_o);
    let ((sin, cos), (s_o, c_o)) = (theta.sin_cos(), theta_o.sin_cos());
    sin * s_o * cos_phi + cos * c_o
}

/// Refuses a magnetic axis on the Z axis, given `sin^2 Theta`.
fn refuse_pole(sin_squared: f64) -> Result<(), Error> {
    let sin = sin_squared.sqrt();
    Error::ensure(
        sin > f64::EPSILON,
        "sin Theta of the magnetic axis",
        sin,
        "above 2.2e-16; on Z the axis has no azimuth",
    )
}
