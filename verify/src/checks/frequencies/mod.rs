//! Frequencies: exact ones, those of the averaged motion, and their behaviour near the separatrix.

pub(super) mod averaged;
pub(super) mod middle_axis;
pub(super) mod scenes;
pub(super) mod torus;
