//! Scene files of the model `twofold` and what is computed from them: tables, sweeps, timing files, measured data.

pub mod columns;
pub mod estimated_error;
pub mod explained_plan;
pub mod measurements;
pub mod plan;
pub mod pulsar_table;
pub mod pulsar_timing;
pub mod random;
pub mod read_table;
mod samples;
pub mod scene_file;
pub mod significant;
pub mod sweep;
pub mod trajectory;
pub mod wave;
mod window;

/// The compiler of this build.
pub const COMPILER: &str = env!("TWOFOLD_RUSTC");

/// The machine that this build is for, as a target triple.
pub const TARGET: &str = env!("TWOFOLD_TARGET");
