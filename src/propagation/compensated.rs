//! Sums that keep what each addition loses.

use crate::propagation::series::Vectors;
use crate::rounding::two_sum;
use crate::scalar::Scalar;

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
pub(super) struct CompensatedState<S, const V: usize> {
    pub(super) high: Vectors<S, V>,
    pub(super) low: Vectors<S, V>,
}

impl<S: Scalar, const V: usize> CompensatedState<S, V> {
    pub(super) fn new(state: &Vectors<S, V>) -> Self {
        Self { high: *state, low: Vectors::zeros() }
    }

    pub(super) fn add(&mut self, change: &Vectors<S, V>) {
        for ((high, low), change) in self.high.iter_mut().zip(self.low.iter_mut()).zip(change.iter()) {
            (*high, *low) = two_sum(*high, *change + *low);
        }
    }
}
