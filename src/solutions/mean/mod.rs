//! Motion averaged over the fast rotation of the symmetry axis about the angular momentum.

mod generator;
mod hamiltonian;
mod middle_axis;
mod motion;
pub mod slow_precession;
mod top;

pub(in crate::solutions) use generator::mean_direction;
pub use generator::{generator, generator_slopes};
pub use hamiltonian::{MeanOrder, mean_potential};
pub use middle_axis::{middle_axis_growth, period_near_separatrix};
pub use motion::{MeanMotion, MeanPhases, MeanRates};
pub use top::{Top, TopPhases, TopShape};
