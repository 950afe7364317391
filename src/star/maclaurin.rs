//! Maclaurin spheroid: a uniform fluid in equilibrium, rotating about its axis. Eqs. (14)-(18), (76)-(78).
//!
//! ```
//! use twofold::star::maclaurin::MaclaurinSpheroid;
//! use twofold::star::uniform_spheroid::UniformSpheroid;
//!
//! let star = MaclaurinSpheroid::new(UniformSpheroid::from_semi_axes(1.0_f64, 0.9, 1.0)?)?;
//! // K^zz + P = U^zz, Eq. (14).
//! assert!((star.pressure_integral - star.spheroid.potential_energy_tensor().zz).abs() < 1e-13);
//! assert!(star.pressure(1.0, 0.0).abs() < 1e-15 && star.pressure(0.0, 0.0) == star.central_pressure);
//! # Ok::<(), twofold::Error>(())
//! ```

use core::f64::consts::PI;

use crate::error::Error;
use crate::numerics::scalar::Real;
use crate::star::AxisymmetricTensor;
use crate::star::potential_coefficients::potential_coefficients;
use crate::star::uniform_spheroid::UniformSpheroid;

/// A uniform oblate spheroid that rotates at the rate of hydrostatic equilibrium. Units with G = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaclaurinSpheroid<S> {
    /// The body.
    pub spheroid: UniformSpheroid<S>,
    /// Squared rotation rate `|Omega|^2 = 2 pi rho (A_1 - (a3^2 / a1^2) A_3)`, Eq. (77); `(8 pi / 15) rho e^2` near the sphere. Its
    /// derivatives are regular there, whereas the rate itself, proportional to `e`, has no derivative there.
    pub rotation_rate_squared: S,
    /// Kinetic energy `T_rot = I^zz |Omega|^2 / 2`, which is `2 C`, Eq. (78) `[estc]`.
    pub rotational_energy: S,
    /// Tensor `K^ij = int rho v^i v^j d^3x`, Eq. (15): `K^xx = |Omega|^2 M a1^2 / 5`, `K^zz = 0`, Eq. (18).
    pub kinetic_tensor: AxisymmetricTensor<S>,
    /// Pressure at the centre, `p_c = pi rho^2 A_3 a3^2`.
    pub central_pressure: S,
    /// Integral `P = int p d^3x = (2/5) p_c V`, Eq. (15), equal to `U^zz` by Eq. (14) with `K^zz = 0`.
    pub pressure_integral: S,
}

impl<S: Real> MaclaurinSpheroid<S> {
    /// The Maclaurin spheroid from an oblate or spherical spheroid.
    ///
    /// # Errors
    /// [`Error::Domain`] for a prolate spheroid: by Eq. (77) it would have `|Omega|^2 < 0`.
    pub fn new(spheroid: UniformSpheroid<S>) -> Result<Self, Error> {
        let e2 = spheroid.shape.eccentricity_squared.re();
        Error::ensure(e2 >= 0.0, "squared eccentricity e^2", e2, "not negative; no equilibrium is prolate")?;
        let (coefficients, rho, a3) =
            (potential_coefficients(&spheroid.shape), spheroid.density, spheroid.polar_radius());
        let rotation_rate_squared = rho * coefficients.difference * (2.0 * PI);
        let central_pressure = rho * rho * coefficients.a3 * a3 * a3 * PI;
        Ok(Self {
            spheroid,
            rotation_rate_squared,
            rotational_energy: spheroid.moment_of_inertia().zz * rotation_rate_squared * 0.5,
            kinetic_tensor: AxisymmetricTensor {
                xx: rotation_rate_squared * spheroid.second_moments().xx,
                zz: S::zero(),
            },
            central_pressure,
            pressure_integral: central_pressure * spheroid.volume() * 0.4,
        })
    }

    /// Pressure at cylindrical radius `varpi` and height `z`, Eq. (76): `p_c (1 - varpi^2 / a1^2 - z^2 / a3^2)`; negative
    /// values mean a point outside.
    pub fn pressure(&self, varpi: S, z: S) -> S {
        let (u, w) = (varpi / self.spheroid.equatorial_radius, z / self.spheroid.polar_radius());
        self.central_pressure * (S::one() - u * u - w * w)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pressure is the central one at the centre and falls with the square of the distance, relative to the distance of the surface.
    #[test]
    fn the_pressure_falls_to_zero_at_the_surface() {
        let spheroid = UniformSpheroid::from_semi_axes(1.3, 0.8, 0.7).unwrap();
        let star = MaclaurinSpheroid::new(spheroid).unwrap();
        for part in [0.0, 0.3, 0.8, 1.0, 1.5] {
            for colatitude in [0.0_f64, 0.4, 1.2, 3.0] {
                let (sin, cos) = colatitude.sin_cos();
                let pressure = star.pressure(1.3 * part * sin, 0.8 * part * cos);
                assert!((pressure / star.central_pressure - (1.0 - part * part)).abs() < 1e-14, "{part} {colatitude}");
            }
        }
    }

    /// The fluid star at rest.
    #[test]
    fn a_sphere_does_not_rotate() {
        let star = MaclaurinSpheroid::new(UniformSpheroid::from_semi_axes(1.3, 1.3, 0.7).unwrap()).unwrap();
        assert_eq!((star.rotation_rate_squared, star.rotational_energy), (0.0, 0.0));
        assert!(MaclaurinSpheroid::new(UniformSpheroid::from_semi_axes(1.3, 1.31, 0.7).unwrap()).is_err());
    }

    /// For a thin disc the components along the axis are proportional to its thickness, and so is the rounding of their balance.
    #[test]
    fn each_component_is_balanced_within_its_own_rounding() {
        for thickness in [0.7, 1e-3, 3e-7, 1e-9, 7e-10, 3e-11] {
            let star =
                MaclaurinSpheroid::new(UniformSpheroid::from_semi_axes(1.3, 1.3 * thickness, 0.7).unwrap()).unwrap();
            let (k, p, u) = (star.kinetic_tensor, star.pressure_integral, star.spheroid.potential_energy_tensor());
            for (left, size) in [(k.xx + p - u.xx, u.xx), (k.zz + p - u.zz, u.zz)] {
                assert!(f64::abs(left) < 1e-14 * size, "{thickness}: {left:e} of {size:e}");
            }
        }
    }
}
