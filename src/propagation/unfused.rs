//! Processors for which the vectors of doubles have no instructions of their own.

use crate::propagation::arithmetic::Plain;

/// Plain arithmetic.
pub(super) type Fused = Plain<f64>;

/// There are none.
pub(super) fn detect_fused() -> Option<Fused> {
    None
}

/// Runs `work`.
pub(super) fn run_fused<R>(_: Fused, work: impl FnOnce() -> R) -> R {
    work()
}
