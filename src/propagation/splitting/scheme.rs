//! A splitting scheme: the weights of its rotations and kicks.

/// The flow with which a scheme starts and ends; a symmetric scheme starts and ends with the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// `A B A ... B A`: rotations of `n`, one more than kicks.
    Rotations,
    /// `B A B ... A B`: kicks of `L`, one more than rotations.
    Kicks,
}

/// A symmetric splitting scheme for `H = T(L) + V(n)`.
///
/// One step over the time `h` turns `n` about `L` for the times `rotations[i] h`, alternating with kicks of `L` by the
/// potential `kicks[i] V - gradients[i] h^2 Gamma.Gamma / I^xx` over `h` (`Gamma` the torque), first at the end named by `ends`. Every list is
/// symmetric, and the first two sum to one each.
///
/// Its error after a fixed time is a sum of terms of the size `s^k h^orders[k-1]` with `s` the size of `s^IJ`, the last entry standing for
/// all higher powers of `s` as well.
#[derive(Debug, PartialEq)]
pub struct Scheme {
    /// Short name.
    pub name: &'static str,
    /// Orders in `h` of the terms of the error with one, two, three and more factors of `s`.
    pub orders: [u32; 3],
    /// Flow at both ends.
    pub ends: Ends,
    /// Weights of the rotations.
    pub rotations: &'static [f64],
    /// Weights of the kicks.
    pub kicks: &'static [f64],
    /// Weights of the force gradient in the kicks, none for a scheme without.
    pub gradients: &'static [f64],
    /// Where the weights were published, or how they were found.
    pub source: &'static str,
}

impl Scheme {
    /// Order in `h` at a fixed `s`.
    pub fn order(&self) -> u32 {
        self.orders[0].min(self.orders[1]).min(self.orders[2])
    }

    /// Weight of the force gradient in one kick.
    pub(super) fn gradient(&self, kick: usize) -> f64 {
        self.gradients.get(kick).copied().unwrap_or(0.0)
    }

    /// Rotations per step, where the last flow of a step and the first of the next are done in one.
    pub fn stages(&self) -> usize {
        self.rotations.len().min(self.kicks.len())
    }
}
