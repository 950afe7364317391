//! Entry points for fuzzing, one for each kind of input; the test suite replays the fuzzer's findings.
//!
//! A function returns for any bytes. It panics if a promise is broken: a file is used or refused with a message, a written number is
//! finite, a table continued after damage equals the undamaged one. The work for an input is bounded here where the program lets a
//! user ask for hours. `scripts/fuzz` runs the search, `tools/fuzz/corpus` holds its findings, and `docs/reliability/fuzzing.md`
//! states how much was searched.

mod bytes;
mod command_line;
#[cfg(test)]
mod corpus;
mod data;
mod model;
mod resume;
mod scene;
mod sweep;
mod timing;

pub use command_line::command_line;
pub use data::{authors_data, data_file, pulsars};
pub use model::model;
pub use resume::resume;
pub use scene::scene;
pub use sweep::sweep;
pub use timing::{table, timing_file, timing_model};

/// Name of a target, and its function of bytes.
pub type Target = (&'static str, fn(&[u8]));

/// All targets.
pub const TARGETS: [Target; 11] = [
    ("scene", scene),
    ("sweep", sweep),
    ("resume", resume),
    ("authors_data", authors_data),
    ("data_file", data_file),
    ("pulsars", pulsars),
    ("command_line", command_line),
    ("model", model),
    ("timing_file", timing_file),
    ("timing_model", timing_model),
    ("table", table),
];
