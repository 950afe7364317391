//! The two kinds of precession, the two forms of the perturbation solutions, and their constants of integration.

/// The choice of formulas for a perturbation solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Form {
    /// Eqs. (30) `[sol2]`, (31) `[consdef]`, (33) `[sol3]` as the paper prints them: they define its examples and curves.
    Printed,
    /// The solution of the full first-order equations ([`full_residuals`](super::linearised::full_residuals)), for use.
    Corrected,
}

/// The free motion that is perturbed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Precession {
    /// A freely precessing star: the upper signs of Eqs. (29)-(34).
    Twofold,
    /// A star in stationary spin: the lower signs.
    Single,
}

impl Precession {
    /// `+1` for the upper sign, `-1` for the lower.
    pub fn sign(self) -> f64 {
        match self {
            Precession::Twofold => 1.0,
            Precession::Single => -1.0,
        }
    }
}

/// Constants of integration `alpha_0`, `beta_0`, `A`, `phi` of Eqs. (27) `[ansatz]` and (30) `[sol2]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants<S> {
    /// Mean precession angle at `t = 0` (rad).
    pub alpha_0: S,
    /// Mean inclination (rad).
    pub beta_0: S,
    /// Amplitude `A` of the homogeneous solution, a rate.
    pub amplitude: S,
    /// Phase `phi` of the homogeneous solution (rad).
    pub phase: S,
}
