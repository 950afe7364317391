//! Scene files of the model `twofold` and the results computed from them: tables, sweeps, timing files, measured data.

pub mod columns;
pub mod estimated_error;
pub mod explained_plan;
pub mod measurements;
pub mod plan;
pub mod pulsar_table;
pub mod pulsar_timing;
pub mod random;
pub mod read_table;
mod refusal;
mod samples;
pub mod scene_file;
pub mod significant;
pub mod sweep;
pub mod text_file;
pub mod trajectory;
pub mod wave;
mod window;

pub use refusal::Refusal;

/// The compiler of this build.
pub const COMPILER: &str = env!("TWOFOLD_RUSTC");

/// The target triple of this build.
pub const TARGET: &str = env!("TWOFOLD_TARGET");
