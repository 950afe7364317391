//! Motions in closed form: no integration, any time at the same cost.

mod averaged;
mod symmetric;
mod uniform;

pub use averaged::AveragedMotion;
pub use symmetric::SymmetricMotion;
pub use uniform::{UniformMotion, largest_torque};
