//! Centrifugal deformation of a rotating star. Eq. (20).
//!
//! ```
//! use twofold::star::deformation::{CENTRIFUGAL_COEFFICIENT, centrifugal_oblateness, centrifugal_oblateness_scaled};
//! use twofold::units::geometrised::{HERTZ, KILOMETRE, SOLAR_MASS};
//!
//! // 1.4 solar masses, 10 km, 100 Hz: in units with G = c = 1, and by the scaled form.
//! let oblateness = centrifugal_oblateness(100.0 * HERTZ, 10.0 * KILOMETRE, 1.4 * SOLAR_MASS);
//! assert!((oblateness / CENTRIFUGAL_COEFFICIENT - 1.0).abs() < 1e-14);
//! assert!((centrifugal_oblateness_scaled(100.0, 10.0, 1.4) / oblateness - 1.0).abs() < 1e-14);
//! ```

use core::f64::consts::PI;

use crate::numerics::scalar::Scalar;
use crate::units::si;

/// The value that the paper prints for the coefficient of Eq. (20) `[epf]`; the computed one is [`CENTRIFUGAL_COEFFICIENT`].
pub const PRINTED_CENTRIFUGAL_COEFFICIENT: f64 = 2.1e-3;

/// Fluid oblateness `eps_f = |Omega|^2 R^3 / M`, Eq. (20) `[epf]`, first form: an order-of-magnitude estimate.
///
/// `omega` [rad / time], `radius` and `mass` in units with G = 1. For a uniform star of small `e` the exact oblateness is
/// 5/4 of this estimate.
pub fn centrifugal_oblateness<S: Scalar>(omega: S, radius: S, mass: S) -> S {
    omega * omega * radius * radius * radius / mass
}

/// Coefficient of the second form of Eq. (20) `[epf]`: `eps_f` at 100 Hz, 10 km and 1.4 solar masses, 2.1249e-3.
pub const CENTRIFUGAL_COEFFICIENT: f64 = {
    let omega = 2.0 * PI * 100.0;
    omega * omega * 1e12 / (1.4 * si::SOLAR_MASS_PARAMETER)
};

/// Fluid oblateness by the second form of Eq. (20) `[epf]`,
/// `coefficient (f / 100 Hz)^2 (R / 10 km)^3 (1.4 M_sun / M)`, with the coefficient from the constants.
///
/// `frequency` in Hz, `radius` in km, `mass` in solar masses.
pub fn centrifugal_oblateness_scaled<S: Scalar>(frequency: S, radius: S, mass: S) -> S {
    let (f, r) = (frequency / 100.0, radius / 10.0);
    f * f * r * r * r / mass * (1.4 * CENTRIFUGAL_COEFFICIENT)
}
