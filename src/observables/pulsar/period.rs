//! The pulsar period from the rate of the magnetic axis' azimuth. Eqs. (51), (52).
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::observables::pulsar::period::{approximate_period, azimuth_offset_rate, azimuth_rate, instantaneous_period};
//!
//! // A star that turns once in 2 pi about Z.
//! let (m, omega) = (Vector3::new(0.6, 0.0, 0.8), Vector3::z());
//! assert!((instantaneous_period(azimuth_rate(&m, &omega)) - core::f64::consts::TAU).abs() < 1e-15);
//! // Eq. (51) at constant inclination: alpha' = 1.4, gamma' = 0.2.
//! let (beta, gamma, chi, delta) = (0.7, 0.1, 0.5, 0.2);
//! assert!(approximate_period(1.4, azimuth_offset_rate(beta, gamma, 0.2, chi, delta)) > 0.0);
//! ```

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::direction::azimuth_offset_point;
use crate::numerics::scalar::Scalar;
use crate::observables::sin_cos_of_sum;

/// Exact rate of the azimuth, `Phi' = [Omega_Z - (Omega.m) m_Z] / (m_X^2 + m_Y^2)`, of an axis `m` fixed in a body that
/// turns with `omega` (both in inertial components); the denominator of Eq. (51) `[pulsep]`.
///
/// Not finite where `m` is on the Z axis; near it the relative error grows as `1 / sin^2 Theta`.
pub fn azimuth_rate<S: Scalar>(axis: &Vector3<S>, omega: &Vector3<S>) -> S {
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
/// Not finite where the magnetic axis is on the Z axis.
pub fn azimuth_offset_rate<S: Scalar>(beta: S, gamma: S, gamma_rate: S, chi: S, delta: S) -> S {
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
