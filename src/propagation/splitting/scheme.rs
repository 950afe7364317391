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
/// One step over the time `h` rotates `n` about `L` for the times `rotations[i] h`, alternating with kicks of `L` by the potential
/// `kicks[i] V - gradients[i] h^2 Gamma.Gamma / I^xx` over `h` (`Gamma` the torque), beginning with the flow named by `ends`. Every list is
/// symmetric, and the first two sum to one each.
///
/// Its error after a fixed time is a sum of terms of the size `s^k h^orders[k-1]` with `s` the size of `s^IJ`; the last entry also covers
/// all higher powers of `s`.
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
    /// Weights of the force gradient in the kicks, empty for a scheme without it.
    pub gradients: &'static [f64],
    /// Publication of the weights, or the way they were found.
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

    /// Rotations per step, if the last flow of a step is merged with the first of the next.
    pub fn stages(&self) -> usize {
        self.rotations.len().min(self.kicks.len())
    }
}
