//! The paper's statements that can be true or false, each with a verdict and the checks behind it. `docs/claims.md` is this
//! list with the figures measured; a test keeps it so.

mod observables;
mod page;
mod rotation;

pub use page::{Evidence, evidence, markdown};

/// What became of a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It holds as printed.
    Confirmed,
    /// Its core holds; something printed with it does not, or it holds in other limits than stated.
    Corrected,
    /// It was right when written; a later result goes further.
    Superseded,
    /// It does not hold.
    NotReproduced,
}

impl Verdict {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Confirmed, Self::Corrected, Self::Superseded, Self::NotReproduced];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Confirmed => "confirmed",
            Verdict::Corrected => "confirmed with a correction",
            Verdict::Superseded => "superseded",
            Verdict::NotReproduced => "not reproduced",
        }
    }
}

/// One statement of the paper.
#[derive(Debug, Clone, Copy)]
pub struct Claim {
    /// Kebab-case name, of its own.
    pub id: &'static str,
    /// Where the paper says it.
    pub place: &'static str,
    /// What it says, in our words.
    pub statement: &'static str,
    /// Whether it holds.
    pub verdict: Verdict,
    /// What was found, where there is more to say than that it holds; for a confirmed statement a remark.
    pub finding: &'static str,
    /// Ids of the checks that the verdict rests on: if one of them fails, the verdict is void.
    pub checks: &'static [&'static str],
    /// Golden tables with the numbers.
    pub golden: &'static [&'static str],
}

/// All statements, in the order of the paper.
pub fn claims() -> impl Iterator<Item = &'static Claim> {
    rotation::CLAIMS.iter().chain(observables::CLAIMS)
}
