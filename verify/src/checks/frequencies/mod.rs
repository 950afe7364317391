//! Frequencies: exact ones, those of the averaged motion, and what becomes of them near the separatrix.

mod averaged;
mod middle_axis;
mod scenes;
mod torus;

use crate::check::Check;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    [torus::checks(), averaged::checks(), middle_axis::checks()].concat()
}
