//! Entry points for fuzzing, one for each kind of input; the test suite replays what the fuzzer has found.
//!
//! A function returns whatever the bytes are. It panics where a promise is broken: a file is used or refused with a message, a number
//! that is written is finite, a table that goes on after damage is the undamaged one. The work of an input is bounded here where the
//! program lets a user ask for hours. `scripts/fuzz` runs the search, `tools/fuzz/corpus` holds what it has found, and
//! `docs/reliability/fuzzing.md` tells how much was searched.

mod bytes;
mod command_line;
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

/// A function that takes bytes, and its name.
pub type Target = (&'static str, fn(&[u8]));

/// All of them.
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
