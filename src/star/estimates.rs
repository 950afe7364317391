//! Estimates of `I^zz / C` and of the unit of time from density and oblateness. Eqs. (43), (58).
//!
//! Both hold for the uniform spheroid to leading order in the oblateness `eps`, with a relative error of order `eps`. The exact counterparts are
//! [`UniformSpheroid::polar_inertia_over_c`](crate::star::uniform_spheroid::UniformSpheroid::polar_inertia_over_c) and
//! [`UniformSpheroid::time_unit`](crate::star::uniform_spheroid::UniformSpheroid::time_unit).
//!
//! ```
//! use twofold::star::estimates::{inertia_over_c_estimate, time_unit_estimate};
//! use twofold::units::geometrised::GRAM_PER_CUBIC_CENTIMETRE;
//!
//! let (density, oblateness) = (3e14 * GRAM_PER_CUBIC_CENTIMETRE, 1e-6_f64);
//! let unit = time_unit_estimate(density, oblateness)?;
//! assert!((unit.powi(2) / inertia_over_c_estimate(density, oblateness) - 1.0).abs() < 1e-12);
//! # Ok::<(), twofold::Error>(())
//! ```

use core::f64::consts::PI;

use crate::error::Error;
use crate::numerics::scalar::Real;
use crate::units::time_unit;

/// Estimate `I^zz / C ~ 15 / (4 pi rho eps)`, Eq. (43) [time^2].
///
/// `density` in units with G = 1 (multiply g/cm^3 by
/// [`GRAM_PER_CUBIC_CENTIMETRE`](crate::units::geometrised::GRAM_PER_CUBIC_CENTIMETRE) for s^2), `oblateness` dimensionless
/// and not zero. The exact ratio is `1 + (5/7) eps + O(eps^2)` times it.
pub fn inertia_over_c_estimate<S: Real>(density: S, oblateness: S) -> S {
    S::from_f64(15.0 / (4.0 * PI)) / (density * oblateness)
}

/// Estimate `t_c ~ sqrt(15 / (4 pi rho eps))`, Eq. (58).
///
/// # Errors
/// [`Error::Domain`] unless density times oblateness is positive.
pub fn time_unit_estimate<S: Real>(density: S, oblateness: S) -> Result<S, Error> {
    time_unit(inertia_over_c_estimate(density, oblateness))
}
