//! Motion averaged over the fast rotation of the symmetry axis about the angular momentum.

mod error;
mod generator;
mod hamiltonian;
mod middle_axis;
mod motion;
mod phases;
pub mod slow_precession;
mod top;

pub(in crate::solutions) use generator::mean_direction;
pub use generator::{generator, generator_slopes};
pub use hamiltonian::{MeanOrder, mean_angular_velocity, mean_potential};
pub use middle_axis::{middle_axis_growth, period_near_separatrix};
pub use motion::MeanMotion;
pub use phases::{MeanPhases, MeanRates, MeanTurns, Turns};
pub(crate) use top::mean_and_sn2;
pub use top::{Top, TopPhases, TopShape};
