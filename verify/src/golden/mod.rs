//! The paper's numbers beside ours, one table per figure, table or passage of the paper.

mod captions;
mod line;
mod star;

pub use line::{GoldenLine, Printed};

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
        for line in &self.lines {
            writeln!(f, "{}", line.aligned(width))?;
        }
        Ok(())
    }
}

/// All golden tables.
///
/// # Errors
/// If a number cannot be computed.
pub fn tables() -> Result<Vec<GoldenTable>, twofold::Error> {
    Ok(vec![captions::initial_values()?, captions::constants()?, star::estimates()?, star::expansions()?])
}
