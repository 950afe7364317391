//! The pulsar period from the rate of the magnetic axis' azimuth. Eqs. (51), (52).

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::direction::{azimuth_offset_point, refuse_pole};
use super::sin_cos_of_sum;
use crate::error::Error;
use crate::scalar::{Real, Scalar};

/// Exact rate of the azimuth, `Phi' = [Omega_Z - (Omega.m) m_Z] / (m_X^2 + m_Y^2)`, of an axis `m` fixed in a body that
/// turns with `omega` (both in inertial components); the denominator of Eq. (51) `[pulsep]`.
///
/// # Errors
/// [`Error::Domain`] where `m` is on the Z axis. Near it the relative error grows as `1 / sin^2 Theta`.
pub fn azimuth_rate<S: Real>(axis: &Vector3<S>, omega: &Vector3<S>) -> Result<S, Error> {
    refuse_pole((axis.x * axis.x + axis.y * axis.y).re())?;
    Ok(azimuth_rate_off_pole(axis, omega))
}

/// [`azimuth_rate`] without the check of its domain, for exact fields.
pub fn azimuth_rate_off_pole<S: Scalar>(axis: &Vector3<S>, omega: &Vector3<S>) -> S {
    // (m x (Omega x m))_Z without the cancellation of 1 - m_Z^2.
    let across = axis.x * axis.x + axis.y * axis.y;
    omega.z - (omega.x * axis.x + omega.y * axis.y) * axis.z / across
}

/// Rate of `DeltaPhi = Phi - alpha` at constant `beta`, Eq. (52), with numerator and denominator multiplied by
/// `sin^2 chi`, so that it is regular at `chi = 0`:
///
/// ```text
/// DeltaPhi' = -g' sin chi [sin b cos chi sin(g + delta) - cos b sin chi] / sin^2 Theta
/// ```
///
/// # Errors
/// [`Error::Domain`] where the magnetic axis is on the Z axis.
pub fn azimuth_offset_rate<S: Real>(beta: S, gamma: S, gamma_rate: S, chi: S, delta: S) -> Result<S, Error> {
    let (x, y) = azimuth_offset_point(beta, gamma, chi, delta);
    refuse_pole((x * x + y * y).re())?;
    Ok(azimuth_offset_rate_off_pole(beta, gamma, gamma_rate, chi, delta))
}

/// [`azimuth_offset_rate`] without the check of its domain, for exact fields.
pub fn azimuth_offset_rate_off_pole<S: Scalar>(beta: S, gamma: S, gamma_rate: S, chi: S, delta: S) -> S {
    let (sin_g, _) = sin_cos_of_sum(gamma, delta);
    let ((sb, cb), (s_chi, c_chi)) = (beta.sin_cos(), chi.sin_cos());
    let (x, y) = azimuth_offset_point(beta, gamma, chi, delta);
    -(gamma_rate * s_chi * (sb * c_chi * sin_g - cb * s_chi)) / (x * x + y * y)
}

/// The period `P = 2 pi / Phi'` of the instantaneous rate `Phi'`, Eq. (51) `[pulsep]`; negative for a retrograde azimuth.
pub fn instantaneous_period<S: Scalar>(azimuth_rate: S) -> S {
    S::from_f64(TAU) / azimuth_rate
}

/// The period to first order in `DeltaPhi' / alpha'`, `P = (2 pi / alpha') (1 - DeltaPhi' / alpha')`, Eq. (51) `[pulsep]`.
pub fn approximate_period<S: Scalar>(alpha_rate: S, offset_rate: S) -> S {
    (S::one() - offset_rate / alpha_rate) * TAU / alpha_rate
}
