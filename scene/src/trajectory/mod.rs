//! The motion of a scene as tables of comma-separated values.

mod error;
mod pulse_source;
mod pulses;
#[cfg(test)]
mod pulses_across_stretches;
mod spectrum;
mod stretches;
mod table;

pub use error::TrajectoryError;
pub use pulses::{PulseSummary, write_pulses};
pub use spectrum::{Floor, LinesSummary, LinesWanted, Sampling};
pub use stretches::ErrorAtEnd;
pub(crate) use stretches::{PlannedState, Stretches, since_start, since_start_within};
pub use table::{Summary, header, write_csv};
