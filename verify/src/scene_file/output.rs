//! The section `[output]`.

use super::error::Fault;
use super::section::Section;

/// Columns that belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnGroup {
    /// Euler angles.
    Angles,
    /// Rates of the Euler angles.
    Rates,
    /// Equatorial body axis.
    EquatorialAxis,
    /// Symmetry axis.
    SymmetryAxis,
    /// Angular momentum.
    Momentum,
    /// The three first integrals.
    Integrals,
}

impl ColumnGroup {
    /// All groups in the order of the columns.
    pub const ALL: [Self; 6] =
        [Self::Angles, Self::Rates, Self::EquatorialAxis, Self::SymmetryAxis, Self::Momentum, Self::Integrals];

    /// Name in a scene file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Angles => "angles",
            Self::Rates => "rates",
            Self::EquatorialAxis => "e_x",
            Self::SymmetryAxis => "e_z",
            Self::Momentum => "L",
            Self::Integrals => "integrals",
        }
    }
}

pub(super) struct Output {
    pub(super) columns: Vec<ColumnGroup>,
    pub(super) accuracy: f64,
}

const DEFAULT_ACCURACY: f64 = 1e-13;

pub(super) fn read(section: Option<&Section<'_>>) -> Result<Output, Fault> {
    let Some(section) = section else {
        return Ok(Output { columns: ColumnGroup::ALL.to_vec(), accuracy: DEFAULT_ACCURACY });
    };
    section.only(&["columns", "accuracy"])?;
    let accuracy = section.optional("accuracy").map_or(Ok(DEFAULT_ACCURACY), |entry| {
        entry.number_where("a number from 1e-14 to 1e-2", |x| (1e-14..=1e-2).contains(&x))
    })?;
    let Some(list) = section.optional("columns") else {
        return Ok(Output { columns: ColumnGroup::ALL.to_vec(), accuracy });
    };
    let names = ColumnGroup::ALL.map(ColumnGroup::name);
    let allowed = format!("a list of different names out of \"{}\"", names.join("\", \""));
    let entries = list.list(&allowed)?;
    if entries.is_empty() {
        return Err(list.refuse(&allowed));
    }
    let mut wanted = Vec::new();
    for entry in &entries {
        let name = entry.word(&names)?;
        if wanted.contains(&name) {
            return Err(entry.refuse(&allowed));
        }
        wanted.push(name);
    }
    Ok(Output { columns: ColumnGroup::ALL.into_iter().filter(|c| wanted.contains(&c.name())).collect(), accuracy })
}
