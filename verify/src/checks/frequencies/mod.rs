//! Frequencies: exact ones, those of the averaged motion, and what becomes of them near the separatrix.

use crate::prelude::*;

mod averaged;
mod middle_axis;
mod scenes;
mod torus;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    [torus::checks(), averaged::checks(), middle_axis::checks()].concat()
}
