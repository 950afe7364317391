//! Sums that keep what each addition loses.

use crate::numerics::arithmetic::Arithmetic;
use crate::numerics::rounding::two_sum;
use crate::propagation::taylor::series::Vectors;

/// A time as an unevaluated sum, so that many small steps do not add up their rounding.
#[derive(Debug, Clone, Copy)]
pub(super) struct Compensated {
    pub(super) high: f64,
    pub(super) low: f64,
}

impl Compensated {
    pub(super) fn new(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    pub(super) fn add(&mut self, step: f64) {
        let (high, low) = two_sum(self.high, step + self.low);
        (self.high, self.low) = (high, low);
    }
}

/// A state whose additions are compensated: `high` is the state, `low` what its last addition lost.
pub(super) struct CompensatedState<A: Arithmetic, const V: usize> {
    pub(super) high: Vectors<A::Vector, V>,
    pub(super) low: Vectors<A::Vector, V>,
}

impl<A: Arithmetic, const V: usize> CompensatedState<A, V> {
    pub(super) fn new(a: A, state: Vectors<A::Vector, V>) -> Self {
        Self { high: state, low: [a.zero(); V] }
    }

    /// Adds by Knuth's exact sum.
    #[inline(always)]
    pub(super) fn add(&mut self, a: A, change: &Vectors<A::Vector, V>) {
        for i in 0..V {
            let (old, change) = (self.high[i], a.add(change[i], self.low[i]));
            let sum = a.add(old, change);
            let changed = a.sub(sum, old);
            self.low[i] = a.add(a.sub(old, a.sub(sum, changed)), a.sub(change, changed));
            self.high[i] = sum;
        }
    }
}
