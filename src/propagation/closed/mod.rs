//! Motions in closed form: no integration, any time at the same cost.

mod symmetric;
mod uniform;

pub use symmetric::SymmetricMotion;
pub use uniform::{UniformMotion, largest_torque};

use crate::error::Error;

/// Refuses a time outside a span, whose ends may be in either order.
fn within(span: (f64, f64), t: f64) -> Result<(), Error> {
    let (first, last) = span;
    Error::unless(
        first.min(last) <= t && t <= first.max(last),
        "time t",
        t,
        "within the span for which the motion was asked",
    )
}
