//! Position angle of the linear polarization in the rotating-vector model, for a precessing star.
//!
//! In the model of V. Radhakrishnan and D. J. Cooke, Astrophys. Lett. 3, 225 (1969), the polarization is along (or
//! perpendicular to) the projection of the magnetic axis `m` on the sky. Its position angle `psi` is counted as in astronomy,
//! from north through east, counterclockwise as seen by the observer:
//!
//! ```text
//! north = -theta-hat_o   (the projection of +Z),    east = -phi-hat_o = n-hat x north,    n-hat towards the observer
//! tan psi = (m . east) / (m . north)
//! ```
//!
//! The printed formula of that model counts clockwise: its angle is `-psi` (J. E. Everett and J. M. Weisberg, Astrophys. J. 553,
//! 341 (2001)). For a line, such as a polarization, `psi` is known up to half a turn. The model does not require the star to
//! spin about a fixed axis: with `Theta(t)` and `Phi(t)` of Eq. (49) `[tranang]` it holds for any motion.
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::Observer;
//! use twofold::observables::pulsar::position_angle::{
//!     position_angle, position_angle_rate, rotating_vector_gradient, rotating_vector_point, rotating_vector_position_angle, sky_from_inertial,
//! };
//!
//! let (observer, m) = (Observer::at(0.8, 0.4), Vector3::new(0.6, 0.0, 0.8_f64));
//! let (psi, theta) = (position_angle(&m, &observer)?, 0.6_f64.asin());
//! assert!((rotating_vector_position_angle(theta, 0.0, 0.8, 0.4)? - psi).abs() < 1e-14);
//! // The star turns once in 2 pi about Z: psi' is the derivative by the azimuth.
//! let (_, by_azimuth) = rotating_vector_gradient(theta, 0.0, 0.8, 0.4);
//! assert!((position_angle_rate(&m, &Vector3::z(), &observer) - by_azimuth).abs() < 1e-13);
//! let (north, east) = rotating_vector_point(theta, 0.0, 0.8, 0.4);
//! assert!(((sky_from_inertial(&observer) * m).xy() - nalgebra::Vector2::new(north, east)).amax() < 1e-15);
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::{Matrix3, Vector3};

use super::period::azimuth_rate;
use crate::error::Error;
use crate::numerics::scalar::{Real, Scalar};
use crate::observables::Observer;
use crate::observables::sin_cos_of_sum;

/// Rotation from the inertial frame to the sky of an observer: rows north `-theta-hat_o`, east `-phi-hat_o` and, towards the
/// observer, `n-hat`, Eqs. (46), (70) `[thphinertial]`.
pub fn sky_from_inertial<S: Scalar>(observer: &Observer<S>) -> Matrix3<S> {
    Matrix3::from_rows(&[
        -observer.theta_hat.transpose(),
        -observer.phi_hat.transpose(),
        observer.direction.transpose(),
    ])
}

/// Position angle `psi` (rad) of the magnetic axis `m`, a unit vector in inertial components, from -pi to pi.
///
/// # Errors
/// [`Error::Domain`] where `m` is along the line of sight (`|m x n-hat|` not above 2.2e-16): it has no projection.
pub fn position_angle<S: Real>(axis: &Vector3<S>, observer: &Observer<S>) -> Result<S, Error> {
    let on_sky = sky_from_inertial(observer) * axis;
    refuse_line_of_sight(on_sky.x, on_sky.y)?;
    Ok(on_sky.y.atan2(on_sky.x))
}

/// Exact rate `psi' = [Omega.n - (Omega.m)(m.n)] / |m x n|^2` (here `n = n-hat`) of the position angle of an axis `m` fixed in
/// a body that turns with `omega`, all in inertial components.
///
/// Not finite along the line of sight; near it the relative error grows as `1 / |m x n|^2`.
pub fn position_angle_rate<S: Scalar>(axis: &Vector3<S>, omega: &Vector3<S>, observer: &Observer<S>) -> S {
    // The position angle is an azimuth about the line of sight.
    let sky = sky_from_inertial(observer);
    azimuth_rate(&(sky * axis), &(sky * omega))
}

/// The point `(m . north, m . east)` at the angle `psi`, of length `|m x n-hat|`, for the magnetic axis at `(Theta, Phi)` and
/// the observer at `(theta_o, phi_o)` (rad):
///
/// ```text
/// north = cos Theta sin theta_o - sin Theta cos theta_o cos(Phi - phi_o)
/// east  = -sin Theta sin(Phi - phi_o)
/// ```
pub fn rotating_vector_point<S: Scalar>(theta: S, phi: S, theta_o: S, phi_o: S) -> (S, S) {
    let (sin_phi, cos_phi) = sin_cos_of_sum(phi, -phi_o);
    let ((s, c), (s_o, c_o)) = (theta.sin_cos(), theta_o.sin_cos());
    (c * s_o - s * c_o * cos_phi, -(s * sin_phi))
}

/// Position angle `psi` (rad, from -pi to pi) of the magnetic axis at `(Theta, Phi)`, seen from `(theta_o, phi_o)`:
///
/// ```text
/// tan psi = -sin Theta sin(Phi - phi_o) / [cos Theta sin theta_o - sin Theta cos theta_o cos(Phi - phi_o)]
/// ```
///
/// For a star that spins about Z, `Theta = chi` and `theta_o = zeta`, and `psi` is minus the angle of Radhakrishnan and Cooke
/// (1969). For a precessing star, `Theta` and `Phi` are those of Eq. (49) `[tranang]`.
///
/// # Errors
/// As for [`position_angle`].
pub fn rotating_vector_position_angle<S: Real>(theta: S, phi: S, theta_o: S, phi_o: S) -> Result<S, Error> {
    let (north, east) = rotating_vector_point(theta, phi, theta_o, phi_o);
    refuse_line_of_sight(north, east)?;
    Ok(east.atan2(north))
}

/// Derivatives `(d psi / d Theta, d psi / d Phi)` of the rotating-vector model; the rate along a motion is
/// `psi' = (d psi / d Theta) Theta' + (d psi / d Phi) Phi'`.
///
/// ```text
/// d psi / d Theta = -sin theta_o sin(Phi - phi_o) / |m x n|^2
/// d psi / d Phi   = sin Theta [sin Theta cos theta_o - cos Theta sin theta_o cos(Phi - phi_o)] / |m x n|^2
/// ```
///
/// At `Phi = phi_o` the second is `-sin Theta / sin(theta_o - Theta)`, for `Theta = chi` the steepest gradient of the classic
/// model. Valid off the line of sight; on it there is a division by zero.
pub fn rotating_vector_gradient<S: Scalar>(theta: S, phi: S, theta_o: S, phi_o: S) -> (S, S) {
    let (sin_phi, cos_phi) = sin_cos_of_sum(phi, -phi_o);
    let ((s, c), (s_o, c_o)) = (theta.sin_cos(), theta_o.sin_cos());
    let (north, east) = rotating_vector_point(theta, phi, theta_o, phi_o);
    let squared = north * north + east * east;
    (-(s_o * sin_phi) / squared, s * (s * c_o - c * s_o * cos_phi) / squared)
}

/// Refuses a magnetic axis along the line of sight, given its projection on the sky.
fn refuse_line_of_sight<S: Real>(north: S, east: S) -> Result<(), Error> {
    let across = north.re().hypot(east.re());
    let allowed = "above 2.2e-16; along the line of sight m has no position angle";
    Error::ensure(across > f64::EPSILON, "sine of the angle between m and the line of sight", across, allowed)
}
