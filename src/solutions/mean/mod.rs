//! Motion averaged over the fast rotation of the symmetry axis about the angular momentum.

mod generator;
mod hamiltonian;
mod motion;
pub mod slow_precession;
mod top;

pub use generator::{generator, generator_slopes};
pub(in crate::solutions) use generator::mean_direction;
pub use hamiltonian::{MeanOrder, mean_potential};
pub use motion::{MeanMotion, MeanPhases, MeanRates};
pub use top::{Top, TopPhases, TopShape};
