//! Rigid bodies: moments of inertia and the constant of the anisotropic self-energy.

use nalgebra::Vector3;

use crate::error::Error;
use crate::numerics::scalar::{Real, Scalar};
use crate::units::time_unit;

/// Principal moments of inertia `I^xx, I^yy, I^zz` of any rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalInertia<S> {
    /// `I^xx`.
    pub xx: S,
    /// `I^yy`.
    pub yy: S,
    /// `I^zz`.
    pub zz: S,
}

impl<S: Scalar> PrincipalInertia<S> {
    /// Differences `Delta_1 = I^yy - I^zz`, `Delta_2 = I^zz - I^xx`, `Delta_3 = I^xx - I^yy`, Eq. (67).
    pub fn differences(&self) -> [S; 3] {
        [self.yy - self.zz, self.zz - self.xx, self.xx - self.yy]
    }
}

/// A rigid spheroid: `I^xx = I^yy`, `I^zz`, and the constant `C` of its anisotropic self-energy, Eqs. (11), (12).
///
/// In the paper's units `I^xx = C = 1`, so that time is in units of `t_c = sqrt(I^xx / C)`, Eq. (35) `[unitt]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidSpheroid<S> {
    /// Moment of inertia about an equatorial axis, `I^xx = I^yy`.
    pub inertia_xx: S,
    /// Moment of inertia about the symmetry axis, `I^zz`.
    pub inertia_zz: S,
    /// Constant `C` of the anisotropic self-energy, an energy; positive for an oblate star.
    pub constant_c: S,
}

impl<S: Scalar> RigidSpheroid<S> {
    /// The spheroid in the paper's units, `I^xx = C = 1`, from the ratio `I^zz / I^xx`.
    pub fn in_units_of_tc(inertia_ratio: S) -> Self {
        Self { inertia_xx: S::one(), inertia_zz: inertia_ratio, constant_c: S::one() }
    }

    /// The same spheroid in another number type.
    pub fn map<T>(&self, convert: impl Fn(S) -> T) -> RigidSpheroid<T> {
        RigidSpheroid {
            inertia_xx: convert(self.inertia_xx),
            inertia_zz: convert(self.inertia_zz),
            constant_c: convert(self.constant_c),
        }
    }

    /// Oblateness `epsilon = (I^zz - I^xx) / I^xx`, Eq. (19) `[obl]`.
    pub fn oblateness(&self) -> S {
        (self.inertia_zz - self.inertia_xx) / self.inertia_xx
    }

    /// The three principal moments of inertia.
    pub fn inertia(&self) -> PrincipalInertia<S> {
        PrincipalInertia { xx: self.inertia_xx, yy: self.inertia_xx, zz: self.inertia_zz }
    }

    /// `omega = I^zz Omega^z / I^xx` for the spin `Omega^z`, Eq. (28).
    pub fn free_precession_constant(&self, spin: S) -> S {
        self.inertia_zz * spin / self.inertia_xx
    }
}

impl<S: Real> RigidSpheroid<S> {
    /// Rate at which `e_x` rotates about `n` relative to a vector that rotates with `L / I^xx` like `n`: `-epsilon Omega^z`, from
    /// `Omega = L / I^xx - epsilon Omega^z n`. It is constant, since `Omega^z = L.n / I^zz` is. `n` and `L` must be taken as they are given and not
    /// from another frame: the rounding of `L.n` for an `L` almost normal to `n` is multiplied by `1 / I^zz`, which is large for a needle.
    pub(crate) fn rate_about_axis(&self, axis: &Vector3<S>, momentum: &Vector3<S>) -> S {
        -(self.oblateness() * S::inner_product(momentum, axis) / self.inertia_zz)
    }
}

impl<S: Real> RigidSpheroid<S> {
    /// Unit of time `t_c = sqrt(I^xx / C)`, Eq. (35) `[unitt]`.
    ///
    /// # Errors
    /// [`Error::Domain`] unless `C > 0`, which an oblate star has, and as for [`units::time_unit`](crate::units::time_unit).
    pub fn time_unit(&self) -> Result<S, Error> {
        let c = self.constant_c.re();
        Error::ensure(c > 0.0, "constant C of the anisotropic self-energy", c, "above zero, as for an oblate star")?;
        time_unit(self.inertia_xx / self.constant_c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_of_time_is_a_time() {
        let unit =
            |inertia_xx: f64, constant_c: f64| RigidSpheroid { inertia_xx, inertia_zz: 1.0, constant_c }.time_unit();
        assert_eq!(unit(9.0, 4.0), Ok(1.5));
        for (inertia_xx, constant_c) in [(1.0, 0.0), (1.0, f64::INFINITY), (-1.0, 1.0), (-1.0, -1.0), (1.0, f64::NAN)] {
            assert!(unit(inertia_xx, constant_c).is_err(), "{inertia_xx} {constant_c}");
        }
    }
}
