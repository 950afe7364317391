//! The paper's statements that can be true or false, each with a verdict and the checks behind it: `verify/data/claims.toml`. `docs/claims.md` is
//! that list with the measured values; a test keeps it up to date.

mod page;

use std::sync::LazyLock;

use toml::de::{DeTable, DeValue};

pub use page::{Evidence, capital, evidence, markdown};

/// The verdict on a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It holds as printed.
    Confirmed,
    /// Its core holds, but something printed with it does not, or it holds in other limits than stated.
    Corrected,
    /// It was right when written; a later result goes further.
    Superseded,
    /// It does not hold.
    NotReproduced,
}

impl Verdict {
    /// All verdicts.
    pub const ALL: [Self; 4] = [Self::Confirmed, Self::Corrected, Self::Superseded, Self::NotReproduced];

    /// The verdict in words.
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
    /// Unique kebab-case name.
    pub id: &'static str,
    /// Place in the paper.
    pub place: &'static str,
    /// The statement in our words.
    pub statement: &'static str,
    /// Whether it holds.
    pub verdict: Verdict,
    /// The finding, if there is more to say than that the statement holds; for a confirmed statement a remark.
    pub finding: &'static str,
    /// Ids of the checks behind the verdict: if one of them fails, the verdict is void.
    pub checks: &'static [&'static str],
    /// Golden tables with the numbers.
    pub golden: &'static [&'static str],
}

/// All statements, in the order of the paper.
///
/// # Panics
/// If the list compiled into the program is malformed.
pub fn claims() -> impl Iterator<Item = &'static Claim> {
    static CLAIMS: LazyLock<Vec<Claim>> = LazyLock::new(|| {
        let list = DeTable::parse(include_str!("../../data/claims.toml")).expect("the list of claims is TOML");
        let claims = list.get_ref().get("claim").and_then(|claims| claims.get_ref().as_array());
        claims.expect("a list of claims").iter().map(|claim| Claim::read(claim.get_ref())).collect()
    });
    CLAIMS.iter()
}

impl Claim {
    fn read(entry: &DeValue<'_>) -> Self {
        let text = |value: &DeValue<'_>| -> &'static str { value.as_str().expect("a text").to_owned().leak() };
        let field = |key| entry.get(key).map(|value| text(value.get_ref())).unwrap_or_default();
        let names = |key| -> &'static [&'static str] {
            let names = entry.get(key).and_then(|names| names.get_ref().as_array()).into_iter().flatten();
            names.map(|name| text(name.get_ref())).collect::<Vec<_>>().leak()
        };
        let known = entry.as_table().expect("a table").keys().all(|key| {
            ["id", "place", "statement", "verdict", "finding", "checks", "golden"].contains(&key.get_ref().as_ref())
        });
        assert!(known, "{}: a key that no claim has", field("id"));
        let verdict = Verdict::ALL.into_iter().find(|verdict| verdict.name() == field("verdict"));
        Self {
            id: field("id"),
            place: field("place"),
            statement: field("statement"),
            verdict: verdict.expect("a verdict"),
            finding: field("finding"),
            checks: names("checks"),
            golden: names("golden"),
        }
    }
}
