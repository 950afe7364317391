//! Processors for which the vectors of doubles have no instructions of their own.

use crate::numerics::arithmetic::Componentwise;

/// Arithmetic by components.
pub(crate) type Fused = Componentwise<f64>;

/// There are none.
pub(crate) fn detect_fused() -> Option<Fused> {
    None
}

/// Runs `work`.
pub(crate) fn run_fused<R>(_: Fused, work: impl FnOnce() -> R) -> R {
    work()
}
