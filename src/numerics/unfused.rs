//! Fallback for processors without special instructions for vectors of doubles.

use crate::numerics::arithmetic::Componentwise;

/// Arithmetic component by component.
pub(crate) type Fused = Componentwise<f64>;

/// Always `None`: there are no such instructions.
pub(crate) fn detect_fused() -> Option<Fused> {
    None
}

/// Runs `work`.
pub(crate) fn run_fused<R>(_: Fused, work: impl FnOnce() -> R) -> R {
    work()
}
