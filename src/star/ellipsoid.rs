//! Uniform triaxial ellipsoid: potential coefficients, tensor of the gravitational energy, inertias. Eqs. (15), (17), (73).
//!
//! The paper treats spheroids. The anisotropic energy `-(1/2) s^ij U^ij` holds for any body; this is the simplest one
//! without a symmetry axis. Reference: Chandrasekhar, *Ellipsoidal Figures of Equilibrium*, chapter 3.
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::star::ellipsoid::UniformEllipsoid;
//!
//! let body = UniformEllipsoid::new(Vector3::new(1.0, 0.9, 0.8_f64), 1.0)?;
//! assert!((body.coefficients().sum() - 2.0).abs() < 1e-14);
//! let inertia = body.moments_of_inertia();
//! assert!(inertia.x < inertia.y && inertia.y < inertia.z);
//! # Ok::<(), twofold::Error>(())
//! ```

use core::f64::consts::PI;

use nalgebra::Vector3;

use crate::error::Error;
use crate::numerics::elliptic::carlson;
use crate::numerics::scalar::Real;

/// Ellipsoid `x^2 / a1^2 + y^2 / a2^2 + z^2 / a3^2 = 1` of uniform density. Units with G = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UniformEllipsoid<S: Real> {
    /// Semi-axes `(a1, a2, a3)`.
    pub semi_axes: Vector3<S>,
    /// Density `rho`.
    pub density: S,
}

impl<S: Real> UniformEllipsoid<S> {
    /// The ellipsoid from the semi-axes `(a1, a2, a3)`, in any order of size, and the density.
    ///
    /// # Errors
    /// [`Error::Domain`] unless all are positive and finite, and the semi-axes between 1e-60 and 1e60.
    pub fn new(semi_axes: Vector3<S>, density: S) -> Result<Self, Error> {
        for a in semi_axes.map(S::re).iter() {
            let allowed = "from 1e-60 to 1e60, so that no power up to the fifth over- or underflows";
            Error::ensure((1e-60..=1e60).contains(a), "semi-axis", *a, allowed)?;
        }
        let density_is_allowed = density.re() > 0.0 && density.re().is_finite();
        Error::ensure(density_is_allowed, "density rho", density.re(), "positive and finite")?;
        Ok(Self { semi_axes, density })
    }

    /// Mass `(4 pi / 3) rho a1 a2 a3`.
    pub fn mass(&self) -> S {
        self.density * self.product() * (4.0 * PI / 3.0)
    }

    /// Coefficient `A_0 = a1 a2 a3 int_0^inf du / Delta = 2 a1 a2 a3 R_F(a1^2, a2^2, a3^2)` of Eq. (73) [length^2], with
    /// `Delta^2 = (a1^2 + u)(a2^2 + u)(a3^2 + u)`. Equal to `A_1 a1^2 + A_2 a2^2 + A_3 a3^2`.
    pub fn central_coefficient(&self) -> S {
        let [x, y, z] = self.squares();
        self.product() * carlson::rf(x, y, z) * 2.0
    }

    /// Coefficients `A_i = a1 a2 a3 int_0^inf du / ((a_i^2 + u) Delta)` of Eq. (73), with sum 2:
    /// `A_3 = (2/3) a1 a2 a3 R_D(a1^2, a2^2, a3^2)` and its permutations. Each is accurate to a few ulp; differences of
    /// nearly equal ones lose digits by cancellation, unlike those of
    /// [`potential_coefficients`](crate::star::potential_coefficients::potential_coefficients).
    pub fn coefficients(&self) -> Vector3<S> {
        let [x, y, z] = self.squares();
        let factor = self.product() * (2.0 / 3.0);
        Vector3::new(carlson::rd(y, z, x), carlson::rd(z, x, y), carlson::rd(x, y, z)) * factor
    }

    /// Second moments of the mass `int rho x_i^2 d^3x = M a_i^2 / 5`.
    fn second_moments(&self) -> Vector3<S> {
        self.semi_axes.component_mul(&self.semi_axes) * (self.mass() / 5.0)
    }

    /// Moments of inertia `I^xx = M (a2^2 + a3^2) / 5` and so on.
    pub fn moments_of_inertia(&self) -> Vector3<S> {
        let m = self.second_moments();
        Vector3::new(m.y + m.z, m.z + m.x, m.x + m.y)
    }

    /// Diagonal of `U^ij = int rho x^i d_j Phi d^3x`, Eqs. (15) and (17): `U^ii = 2 pi rho A_i M a_i^2 / 5`.
    pub fn potential_energy_tensor(&self) -> Vector3<S> {
        self.coefficients().component_mul(&self.second_moments()) * (self.density * (2.0 * PI))
    }

    fn squares(&self) -> [S; 3] {
        [0, 1, 2].map(|i| self.semi_axes[i] * self.semi_axes[i])
    }

    fn product(&self) -> S {
        self.semi_axes.x * self.semi_axes.y * self.semi_axes.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The three coefficients of any ellipsoid have the sum 2; those of a sphere are equal.
    #[test]
    fn ellipsoids_of_any_allowed_size_have_coefficients() {
        let of = |axes: [f64; 3]| UniformEllipsoid::new(Vector3::from(axes), 1.0);
        for axes in [[1e-60; 3], [1e60; 3], [1e-60, 1.0, 1e60], [1e60, 1e60, 1e-60], [1e-60, 1e-60, 1e60]] {
            let body = of(axes).unwrap();
            assert!((body.coefficients().sum() - 2.0).abs() < 1e-14, "{axes:?}: {}", body.coefficients());
            assert!(body.moments_of_inertia().iter().all(|moment| moment.is_normal()), "{axes:?}");
            assert!(body.central_coefficient().is_normal(), "{axes:?}");
        }
        for axis in [0.9e-60, 1.1e60, 0.0, -1.0, f64::NAN] {
            assert!(of([1.0, axis, 1.0]).is_err(), "{axis}");
        }
        assert!(UniformEllipsoid::new(Vector3::repeat(1.0), f64::INFINITY).is_err());
    }
}
