//! Many scenes: grids, lists and random draws over the parameters of one scene, computed on all cores. The tables grow in
//! order, survive any interruption and are the same to the byte whichever process computed which part and when.
//!
//! A scene's parameters are a function of its number alone, and a row of the table is a function of its scene alone: neither
//! depends on chunks, threads or shards. The format of a sweep file is described in `docs/sweep.md`.

mod chunk;
mod engine;
mod file;
mod identity;
mod journal;
mod merge;
mod outputs;
mod parameters;
#[cfg(feature = "parquet")]
pub mod parquet_file;
mod shard;
mod spin_axis_angle;
mod spool;
#[cfg(test)]
mod tests;

pub use engine::{Done, compute};
pub use file::SweepText;
pub use identity::Identity;
pub use journal::signed_again;
pub use merge::{csv_line, merge, merge_errors};
pub use shard::Shard;
pub use spool::{Spool, SpoolError, SpoolFiles, errors_beside, is_beginning_of};

use twofold::plan::Method;

use crate::scene_file::{BuiltIn, Scene, Units};
use outputs::Outputs;
use parameters::Parameters;

/// Largest number of scenes of a sweep: their numbers are exact as doubles.
pub const MOST_SCENES: u64 = 1_000_000_000_000_000;

/// Largest number of columns of the table of a sweep.
const MOST_COLUMNS: usize = 10_000;

/// Name of the first column: the number of the scene, from zero.
const NUMBER: &str = "scene";

/// Name of the column that states whether the scene could be computed.
const STATUS: &str = "status";

/// Sweeps included with the command, as files to start from.
pub const SWEEPS: &[BuiltIn] = &[BuiltIn { name: "grid", toml: include_str!("../../sweeps/grid.toml") }];

/// A checked sweep.
#[derive(Debug)]
pub struct Sweep<'t> {
    /// Description of the sweep, one line; may be empty.
    pub about: String,
    base: file::Base<'t>,
    parameters: Parameters,
    outputs: Outputs,
    /// Number of scenes.
    pub scenes: u64,
    /// Entries of the scene that look like a mistake, a sentence each.
    pub cautions: Vec<String>,
    tolerance: f64,
    /// The method of every row, if one is named.
    method: Option<Method>,
    units: Units,
    /// Upper estimate of the rotation of the unmodified scene over its span.
    rotation: f64,
}

impl Sweep<'_> {
    /// Names of the columns of the table.
    pub fn header(&self) -> Vec<String> {
        let mut names = vec![NUMBER.to_owned()];
        names.extend(self.parameters.keys.iter().cloned());
        names.push(STATUS.to_owned());
        names.extend(self.outputs.header(&self.units));
        names
    }

    /// Names of the columns of the table of errors.
    pub fn errors_header(&self) -> Vec<String> {
        let mut names = vec![NUMBER.to_owned()];
        names.extend(self.parameters.keys.iter().cloned());
        names.push("error".to_owned());
        names
    }

    /// The scene with this number.
    ///
    /// # Errors
    /// The numbers do not describe a possible scene; the error is the reason that the table of errors gives.
    pub fn scene(&self, number: u64) -> Result<Scene, String> {
        self.scene_with(&self.parameters.of_scene(number))
    }

    fn scene_with(&self, parameters: &[f64]) -> Result<Scene, String> {
        let scene = self.base.scene(&self.parameters.keys, parameters, &self.outputs.times)?;
        Ok(Scene { tolerance: self.tolerance, method: self.method, ..scene })
    }

    /// The lines of the table and of the table of errors for some scenes, computed by one thread, and how many of them
    /// failed.
    pub fn rows(&self, scenes: std::ops::Range<u64>) -> ([Vec<u8>; 2], u64) {
        let chunk::ChunkText { rows, errors, failed } = chunk::chunk_text(self, scenes);
        ([rows, errors], failed)
    }

    /// Number of scenes that are computed together: about a quarter of a second's work and a few megabytes. Results do not
    /// depend on it.
    fn chunk_length(&self) -> u64 {
        let by_time = (5e4 / self.rotation.max(1.0)) as usize;
        let by_memory = 65_536 / self.header().len();
        by_time.min(by_memory).clamp(1, 256).next_multiple_of(8) as u64
    }
}
