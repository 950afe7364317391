//! The paper's numbers compared with ours, one table per figure, table or passage of the paper.

mod captions;
mod certified;
mod eta;
mod line;
mod pulsar_bounds;
mod regimes;
mod spectral_lines;
mod star;

pub use certified::{Certainty, Enclosures, rounds_to};
pub use line::{GoldenLine, Printed};

/// One golden table.
#[derive(Debug, Clone)]
pub struct GoldenTable {
    /// File name of its snapshot, without extension.
    pub name: &'static str,
    /// Title.
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
            let (label, ours) = (&line.label, line.ours_text());
            if nothing_printed {
                writeln!(f, "{label:<width$}  {ours:>15}")?;
            } else {
                let (printed, verdict) = (line.printed_text(), line.verdict());
                writeln!(f, "{label:<width$}  printed {printed:>11}  ours {ours:>15}  {verdict}")?;
            }
        }
        Ok(())
    }
}

/// The golden tables of the verification; those of the figures are computed with the figures.
///
/// # Errors
/// If a number cannot be computed.
pub fn tables() -> Result<Vec<GoldenTable>, String> {
    Ok(vec![
        captions::initial_values()?,
        captions::constants()?,
        pulsar_bounds::table()?,
        eta::table()?,
        star::estimates()?,
        star::expansions()?,
        regimes::twofold()?,
        regimes::single()?,
        spectral_lines::table()?,
    ])
}
