//! Points with rational coordinates.

use crate::prelude::*;

/// A type of numbers in which rational numbers and rational points of the circle can be written.
pub trait Coded: Differentiable {
    /// The number `numerator / denominator`, both small integers.
    fn number(numerator: i32, denominator: i32) -> Self;

    /// The angle with `tan(angle / 2) = numerator / denominator`.
    fn angle(numerator: i32, denominator: i32) -> Self;
}

impl Coded for f64 {
    fn number(numerator: i32, denominator: i32) -> Self {
        Self::from(numerator) / Self::from(denominator)
    }

    fn angle(numerator: i32, denominator: i32) -> Self {
        2.0 * Self::number(numerator, denominator).atan()
    }
}

impl Coded for Conditioned {
    fn number(numerator: i32, denominator: i32) -> Self {
        Self::new(f64::number(numerator, denominator))
    }

    fn angle(numerator: i32, denominator: i32) -> Self {
        Self::new(f64::angle(numerator, denominator))
    }
}

impl Coded for Fp {
    fn number(numerator: i32, denominator: i32) -> Self {
        Self::from_f64(numerator.into()) / Self::from_f64(denominator.into())
    }

    fn angle(numerator: i32, denominator: i32) -> Self {
        // The code of an angle is its t.
        Self::number(numerator, denominator)
    }
}

/// Named numbers and angles.
#[derive(Debug, Clone)]
pub struct RationalPoint<F> {
    values: BTreeMap<String, F>,
}

impl<F: Coded> RationalPoint<F> {
    /// Point from fractions by name; `is_angle` tells angles from numbers.
    pub fn new(fractions: &BTreeMap<String, (i32, i32)>, is_angle: impl Fn(&str) -> bool) -> Self {
        let coded = |name: &str, (n, d): (i32, i32)| if is_angle(name) { F::angle(n, d) } else { F::number(n, d) };
        Self { values: fractions.iter().map(|(name, &fraction)| (name.clone(), coded(name, fraction))).collect() }
    }

    /// The number or angle of this name.
    ///
    /// # Panics
    /// If the point has none: kernels and file do not belong together.
    pub fn at(&self, name: &str) -> F {
        *self.values.get(name).unwrap_or_else(|| panic!("points of symbolic.json have no {name}"))
    }

    pub(super) fn vector(&self, [x, y, z]: [&str; 3]) -> Vector3<F> {
        Vector3::new(self.at(x), self.at(y), self.at(z))
    }

    /// The symmetric matrix whose entries are called `prefix_xx` and so on.
    pub(super) fn symmetric(&self, prefix: &str) -> Matrix3<F> {
        let [xx, yy, zz, xy, xz, yz] = ["xx", "yy", "zz", "xy", "xz", "yz"].map(|k| self.at(&format!("{prefix}_{k}")));
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    }

    pub(super) fn spheroid(&self) -> RigidSpheroid<F> {
        RigidSpheroid { inertia_xx: self.at("i_xx"), inertia_zz: self.at("i_zz"), constant_c: self.at("c") }
    }

    pub(super) fn body(&self) -> PrincipalInertia<F> {
        PrincipalInertia { xx: self.at("j_1"), yy: self.at("j_2"), zz: self.at("j_3") }
    }

    pub(super) fn coefficients(&self) -> PrincipalCoefficients<F> {
        PrincipalCoefficients::new(["s_x", "s_y", "s_z"].map(|name| self.at(name)))
    }

    pub(super) fn angles(&self) -> EulerAngles<F> {
        EulerAngles { alpha: self.at("alpha"), beta: self.at("beta"), gamma: self.at("gamma") }
    }

    pub(super) fn frame(&self) -> EulerAngles<F> {
        let [alpha, beta, gamma] = ["frame_alpha", "frame_beta", "frame_gamma"].map(|name| self.at(name));
        EulerAngles { alpha, beta, gamma }
    }

    pub(super) fn rates(&self) -> EulerRates<F> {
        EulerRates { alpha: self.at("alpha_1"), beta: self.at("beta_1"), gamma: self.at("gamma_1") }
    }

    pub(super) fn state(&self) -> BodyState<F> {
        BodyState::from_angles(&self.spheroid(), &self.angles(), &self.rates())
    }
}
