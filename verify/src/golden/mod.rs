//! The paper's numbers beside ours, one table per figure, table or passage of the paper.

pub(crate) mod captions;
mod certified;
mod eta;
mod figures;
mod line;
pub(crate) mod pulsar_bounds;
mod regimes;
mod spectral_lines;
mod star;

pub use certified::{Certainty, Enclosures};
pub use line::{GoldenLine, Printed};

use crate::figures::Figure;

/// One golden table.
#[derive(Debug, Clone)]
pub struct GoldenTable {
    /// File name of its snapshot, without ending.
    pub name: &'static str,
    /// What it holds.
    pub title: &'static str,
    /// Its lines.
    pub lines: Vec<GoldenLine>,
}

impl std::fmt::Display for GoldenTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        writeln!(f, "{}", self.title)?;
        let width = self.lines.iter().map(|line| line.label.chars().count()).max().unwrap_or(0);
        let nothing_printed = self.lines.iter().all(|line| line.printed == Printed::No);
        for line in &self.lines {
            let text = if nothing_printed { line.aligned_ours(width) } else { line.aligned(width) };
            writeln!(f, "{text}")?;
        }
        Ok(())
    }
}

/// All golden tables; those of the figures are taken from `figures`.
///
/// # Errors
/// If a number cannot be computed.
pub fn tables(figures: &[Figure]) -> Result<Vec<GoldenTable>, String> {
    let text = |error: twofold::Error| error.to_string();
    let mut tables = vec![
        captions::initial_values().map_err(text)?,
        captions::constants().map_err(text)?,
        pulsar_bounds::table()?,
        eta::table().map_err(text)?,
        star::estimates().map_err(text)?,
        star::expansions().map_err(text)?,
        regimes::twofold()?,
        regimes::single()?,
        spectral_lines::table()?,
    ];
    tables.extend(figures::tables(figures)?);
    Ok(tables)
}
