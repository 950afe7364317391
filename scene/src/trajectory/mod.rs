//! The motion of a scene as tables of comma-separated values.

mod error;
mod pulse_source;
mod pulses;
#[cfg(test)]
mod pulses_across_segments;
mod spectrum;
mod table;

pub use error::TrajectoryError;
pub use pulses::{PulseSummary, write_pulses};
pub use spectrum::{LinesSummary, LinesWanted, write_lines};
pub use table::{Summary, header, write_csv};
