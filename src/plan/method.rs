//! The methods of computing a motion.

use crate::propagation::splitting::TANGENTS_AT_ONCE;

/// A method of computing a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// Free rotation in closed form, without the torque. Exact for isotropic `s^IJ`; otherwise with a rigorous bound.
    Free,
    /// Steady precession in closed form, Eq. (26) `[sol1]`, or a body whose axis rests.
    Steady,
    /// Elliptic functions for two equal eigenvalues of `s^IJ`.
    Symmetric,
    /// The averaged motion to second order in `s^IJ`, for bodies whose rotation is fast compared with the effect of the
    /// torque.
    Averaged,
    /// Fourier series on the invariant torus of the motion, for any scene off the separatrix.
    Torus,
    /// A splitting scheme and a step, both chosen for the tolerance.
    Splitting,
    /// Taylor series with adaptive steps and dense output.
    Taylor,
}

impl Method {
    /// Every method, in the order in which plans list them.
    pub const ALL: [Self; 7] =
        [Self::Free, Self::Steady, Self::Symmetric, Self::Averaged, Self::Torus, Self::Splitting, Self::Taylor];

    /// Name for files and commands.
    pub fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Steady => "steady",
            Self::Symmetric => "symmetric",
            Self::Averaged => "averaged",
            Self::Torus => "torus",
            Self::Splitting => "splitting",
            Self::Taylor => "taylor",
        }
    }

    /// Short description.
    pub fn description(self) -> &'static str {
        match self {
            Self::Free => "free rotation in closed form",
            Self::Steady => "steady precession in closed form",
            Self::Symmetric => "elliptic functions for two equal eigenvalues of s^IJ",
            Self::Averaged => "averaged motion to second order in s^IJ",
            Self::Torus => "Fourier series on the invariant torus",
            Self::Splitting => "splitting into exact rotations and kicks",
            Self::Taylor => "Taylor series with adaptive steps and dense output",
        }
    }

    /// The method called `name`.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }

    /// Number of motions that are computed for derivatives with respect to a number of parameters. It is one for each parameter,
    /// but with splitting one motion with tangent maps serves for every sixteen. Without derivatives there is one motion.
    pub(super) fn motions_for(self, derivatives: usize) -> usize {
        let motions = if self == Self::Splitting { derivatives.div_ceil(TANGENTS_AT_ONCE) } else { derivatives };
        motions.max(1)
    }

    /// Whether it keeps its phases to 32 digits, so that a span may have any number of turns.
    pub(crate) fn keeps_phases(self) -> bool {
        matches!(self, Self::Averaged | Self::Torus)
    }

    /// Whether it gives the state at any time without computing earlier times.
    pub fn is_closed_form(self) -> bool {
        !matches!(self, Self::Splitting | Self::Taylor)
    }
}
