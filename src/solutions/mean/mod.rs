//! Motion averaged over the fast rotation of the symmetry axis about the angular momentum.

mod error;
mod generator;
mod hamiltonian;
mod motion;
mod phases;
pub mod slow_precession;
mod top;

pub use generator::{generator, generator_slopes};
pub use hamiltonian::{MeanOrder, mean_potential};
pub use motion::{MeanMotion, MeanPhases, MeanRates};
pub use phases::{MeanTurns, Turns};
pub use top::{Top, TopPhases, TopShape};
