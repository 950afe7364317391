//! Uniform spheroid: mass, inertia, tensor of the gravitational energy and the constant C. Eqs. (10), (12), (17), (19), (75).
//!
//! ```
//! use twofold::star::spheroid_shape::SpheroidShape;
//! use twofold::star::uniform_spheroid::UniformSpheroid;
//! use twofold::units::geometrised::{KILOMETRE, SOLAR_MASS};
//!
//! let shape = SpheroidShape::from_oblateness(1e-3_f64)?;
//! let star = UniformSpheroid::from_mass(1.4 * SOLAR_MASS, 12.0 * KILOMETRE, shape)?;
//! assert!((star.mass() / (1.4 * SOLAR_MASS) - 1.0).abs() < 1e-14 && star.time_unit()? > 1e-3);
//! let same = UniformSpheroid::new(star.equatorial_radius, star.density, shape)?;
//! assert_eq!(same.c(), star.c());
//! # Ok::<(), twofold::Error>(())
//! ```

use core::f64::consts::PI;

use crate::error::Error;
use crate::numerics::rounding::two_product;
use crate::numerics::scalar::Real;
use crate::star::AxisymmetricTensor;
use crate::star::potential_coefficients::{potential_coefficients, reduced_difference};
use crate::star::spheroid_shape::SpheroidShape;
use crate::units::time_unit;

/// `4 pi^2 / 15` to 32 digits, as an unevaluated sum.
const FOUR_PI_SQUARED_OVER_15: (f64, f64) = (2.6318945069571624, -1.2898492633364943e-16);

/// Spheroid of uniform density, oblate, spherical or prolate. Units with G = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UniformSpheroid<S> {
    /// Equatorial semi-axis `a1`.
    pub equatorial_radius: S,
    /// Density `rho`.
    pub density: S,
    /// Shape.
    pub shape: SpheroidShape<S>,
}

impl<S: Real> UniformSpheroid<S> {
    /// The spheroid from the equatorial semi-axis `a1`, the density and the shape.
    ///
    /// # Errors
    /// [`Error::Domain`] unless `a1` and the density are positive and finite.
    pub fn new(equatorial_radius: S, density: S, shape: SpheroidShape<S>) -> Result<Self, Error> {
        positive(equatorial_radius.re(), "equatorial semi-axis a1")?;
        positive(density.re(), "density rho")?;
        Ok(Self { equatorial_radius, density, shape })
    }

    /// The spheroid from the semi-axes `a1` (equatorial) and `a3` (polar) of Eq. (10) `[spheroid]` and the density.
    ///
    /// # Errors
    /// [`Error::Domain`] unless all three are positive and finite, and `a3 / a1` is between 1e-100 and 1e100.
    pub fn from_semi_axes(a1: S, a3: S, density: S) -> Result<Self, Error> {
        Self::new(a1, density, SpheroidShape::from_semi_axes(a1, a3)?)
    }

    /// The spheroid from the mass, the mean radius `R = (a1^2 a3)^(1/3)` and the shape: `rho = 3 M / (4 pi R^3)`,
    /// `a1 = R q^(-1/3)`.
    ///
    /// # Errors
    /// [`Error::Domain`] unless mass and radius are positive and finite.
    pub fn from_mass(mass: S, mean_radius: S, shape: SpheroidShape<S>) -> Result<Self, Error> {
        positive(mass.re(), "mass M")?;
        positive(mean_radius.re(), "mean radius R")?;
        let density = mass * (0.75 / PI) / (mean_radius * mean_radius * mean_radius);
        Self::new(mean_radius / cube_root(shape.axis_ratio), density, shape)
    }

    /// Polar semi-axis `a3`.
    pub fn polar_radius(&self) -> S {
        self.equatorial_radius * self.shape.axis_ratio
    }

    /// Mean radius `R = (a1^2 a3)^(1/3)`.
    pub fn mean_radius(&self) -> S {
        self.equatorial_radius * cube_root(self.shape.axis_ratio)
    }

    /// Volume `(4 pi / 3) a1^2 a3`.
    pub(crate) fn volume(&self) -> S {
        self.equatorial_radius * self.equatorial_radius * self.polar_radius() * (4.0 * PI / 3.0)
    }

    /// Mass `rho V`.
    pub fn mass(&self) -> S {
        self.density * self.volume()
    }

    /// Second moments of the mass, `int rho x^2 d^3x = M a1^2 / 5` and `int rho z^2 d^3x = M a3^2 / 5`.
    pub(crate) fn second_moments(&self) -> AxisymmetricTensor<S> {
        let xx = self.mass() * self.equatorial_radius * self.equatorial_radius / 5.0;
        AxisymmetricTensor { xx, zz: xx * self.shape.axis_ratio_squared }
    }

    /// Moments of inertia `I^zz = (2/5) M a1^2 = (8 pi / 15) rho a1^4 a3` and `I^xx = I^yy = M (a1^2 + a3^2) / 5`.
    pub fn moment_of_inertia(&self) -> AxisymmetricTensor<S> {
        let moments = self.second_moments();
        AxisymmetricTensor { xx: moments.xx + moments.zz, zz: moments.xx * 2.0 }
    }

    /// Tensor `U^ij = int rho x^i d_j Phi d^3x`, Eqs. (15) and (17): `U^xx = 2 pi rho A_1 M a1^2 / 5`,
    /// `U^zz = 2 pi rho A_3 M a3^2 / 5`. Its trace is minus the gravitational energy.
    pub fn potential_energy_tensor(&self) -> AxisymmetricTensor<S> {
        let (a, moments) = (potential_coefficients(&self.shape), self.second_moments());
        let factor = self.density * (2.0 * PI);
        AxisymmetricTensor { xx: factor * a.a1 * moments.xx, zz: factor * a.a3 * moments.zz }
    }

    /// Constant `C = (U^xx - U^zz) / 2 = (4 pi^2 / 15) rho^2 a1^2 a3 (a1^2 A_1 - a3^2 A_3)`, Eqs. (12) and (75), in units of
    /// energy: positive for an oblate spheroid, exactly zero for the sphere, negative for a prolate one.
    ///
    /// The error is at most 4 ulp for exact `a1` and a density of one, for `e` down to 1e-145, below which `e^2` loses digits (3.3
    /// found at 100,000 shapes, `e` from 1e-13 to 0.999 and `a3 / a1` from 1 to 10).
    pub fn c(&self) -> S {
        let surface_density = self.density * self.equatorial_radius * self.equatorial_radius;
        // Of the three products only the last sum is rounded: together with the errors of the factors, more rounding
        // would exceed 4 ulp.
        let (q2, e2) = (self.shape.axis_ratio_squared, self.shape.eccentricity_squared);
        let beta = reduced_difference(&self.shape);
        let (reduced, lost_1) = two_product(e2, beta);
        let (shape, lost_2) = two_product(q2, reduced);
        let (high, low) = FOUR_PI_SQUARED_OVER_15;
        let (constant, lost_3) = two_product(shape, S::from_f64(high));
        let (q2_lost, e2_lost) = self.shape.lost;
        let lost = lost_2 + q2 * lost_1 + reduced * q2_lost + q2 * beta * e2_lost;
        let factor = constant + (lost_3 + lost * high + shape * low);
        factor * (surface_density * surface_density * self.equatorial_radius)
    }

    /// Ratio `C / I^zz = (pi rho / 2) (A_1 - q^2 A_3)` [1 / time^2]; regular at the sphere, where it is zero.
    pub(crate) fn c_over_polar_inertia(&self) -> S {
        self.density * potential_coefficients(&self.shape).difference * (0.5 * PI)
    }

    /// Ratio `I^zz / C` [time^2], which Eq. (43) estimates; negative for a prolate spheroid.
    ///
    /// # Errors
    /// [`Error::Domain`] for the sphere, where `C = 0`, and so near to it that the ratio overflows.
    pub fn polar_inertia_over_c(&self) -> Result<S, Error> {
        let ratio = self.c_over_polar_inertia();
        let allowed = "so large that its inverse is finite; a sphere has no anisotropic energy";
        Error::ensure(ratio.re().recip().is_finite(), "C / I^zz", ratio.re(), allowed)?;
        Ok(S::one() / ratio)
    }

    /// Unit of time `t_c = sqrt(I^xx / C)`, Eq. (35) `[unitt]`.
    ///
    /// # Errors
    /// [`Error::Domain`] unless the spheroid is oblate.
    pub fn time_unit(&self) -> Result<S, Error> {
        time_unit(self.polar_inertia_over_c()? / (self.shape.oblateness() + S::one()))
    }
}

fn positive(value: f64, quantity: &'static str) -> Result<(), Error> {
    Error::ensure(value > 0.0 && value.is_finite(), quantity, value, "positive and finite")
}

/// Cube root of a positive number. The exponential has the rounding of its argument, a hundred ulp for `x = 1e90`; a Newton step removes it.
fn cube_root<S: Real>(x: S) -> S {
    let root = (x.ln() / 3.0).exp();
    let square = root * root;
    root - (square * root - x) / (square * 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_that_overflows_is_refused_like_that_of_a_sphere() {
        let ratio = |e: f64| {
            UniformSpheroid::new(1.0, 1.0, SpheroidShape::from_eccentricity(e).unwrap()).unwrap().polar_inertia_over_c()
        };
        assert!(ratio(1e-150).unwrap().is_normal());
        for e in [0.0, 1e-170, 1e-160, 1e-155] {
            assert!(ratio(e).is_err(), "{e:e}");
        }
    }
}
