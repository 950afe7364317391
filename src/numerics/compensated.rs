//! Compensated sums, which keep the rounding error of each addition.

use crate::numerics::arithmetic::Arithmetic;
use crate::numerics::rounding::two_sum;

/// A time as an unevaluated sum, so that the rounding errors of many small steps do not accumulate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Compensated {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

impl Compensated {
    pub(crate) fn new(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    pub(crate) fn add(&mut self, step: f64) {
        let (high, low) = two_sum(self.high, step + self.low);
        (self.high, self.low) = (high, low);
    }
}

/// Vectors whose additions are compensated: `high` are the vectors, `low` the rounding errors of their last addition.
pub(crate) struct CompensatedVectors<A: Arithmetic, const V: usize> {
    pub(crate) high: [A::Vector; V],
    pub(crate) low: [A::Vector; V],
}

impl<A: Arithmetic, const V: usize> CompensatedVectors<A, V> {
    pub(crate) fn new(a: A, state: [A::Vector; V]) -> Self {
        Self { high: state, low: [a.zero(); V] }
    }

    /// Adds by Knuth's exact sum.
    #[inline(always)]
    pub(crate) fn add(&mut self, a: A, change: &[A::Vector; V]) {
        for i in 0..V {
            let (old, change) = (self.high[i], a.add(change[i], self.low[i]));
            let sum = a.add(old, change);
            let changed = a.sub(sum, old);
            self.low[i] = a.add(a.sub(old, a.sub(sum, changed)), a.sub(change, changed));
            self.high[i] = sum;
        }
    }
}
