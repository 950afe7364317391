//! Rigorous enclosures of golden numbers, computed in ball arithmetic independently of the Rust code (`verify/oracles/certified`,
//! docs/reliability/certified.md). A number is certified to its last printed digit if its enclosure lies within the interval that
//! rounds to these digits.

use super::{GoldenLine, GoldenTable};
use crate::prelude::*;

/// The certainty of a golden number.
#[derive(Debug, Clone, PartialEq)]
pub enum Certainty {
    /// The enclosure lies within the interval that rounds to the printed digits.
    Certified,
    /// There is no enclosure, for this reason.
    NotEnclosed(String),
    /// The enclosure is not inside, or is missing without a reason.
    Wrong(String),
}

/// Enclosures by table and label, and the numbers without one.
#[derive(Debug, Clone)]
pub struct Enclosures {
    ends: BTreeMap<(String, String), (f64, f64)>,
    /// Table, part of the label, reason.
    without: Vec<[String; 3]>,
}

impl Enclosures {
    /// Reads the texts of `verify/data/certified.csv` and `verify/data/not_enclosed.csv`.
    ///
    /// # Errors
    /// If a line is not an enclosure, or a number has a second one.
    pub fn parse(certified: &str, not_enclosed: &str) -> Result<Self, String> {
        let mut ends = BTreeMap::new();
        for [table, label, lower, upper] in rows(certified)? {
            let end = |text: &str| text.parse::<f64>().map_err(|error| format!("certified.csv: {text}: {error}"));
            // Parsing rounds to nearest: one step outwards includes the decimal.
            let outwards = (end(&lower)?.next_down(), end(&upper)?.next_up());
            if ends.insert((table.clone(), label.clone()), outwards).is_some() {
                return Err(format!("certified.csv has two enclosures of {table}: {label}"));
            }
        }
        Ok(Self { ends, without: rows(not_enclosed)? })
    }

    /// The certainty of a line of a table.
    pub fn certainty(&self, table: &GoldenTable, line: &GoldenLine) -> Certainty {
        let printed = line.ours_text();
        if let Some(&(lower, upper)) = self.ends.get(&(table.name.to_owned(), line.label.clone())) {
            return match rounds_to(&printed, lower, upper) {
                true => Certainty::Certified,
                false => Certainty::Wrong(format!("{printed} printed, enclosed in [{lower:e}, {upper:e}]")),
            };
        }
        self.reason(table, line).map_or_else(
            || Certainty::Wrong("neither enclosed nor listed as not enclosed".into()),
            |[_, _, reason]| Certainty::NotEnclosed(reason.clone()),
        )
    }

    /// The first line of `not_enclosed.csv` that matches a number without an enclosure.
    fn reason(&self, table: &GoldenTable, line: &GoldenLine) -> Option<&[String; 3]> {
        let enclosed = self.ends.contains_key(&(table.name.to_owned(), line.label.clone()));
        let fits = |[name, part, _]: &&[String; 3]| !enclosed && name == table.name && line.label.contains(part);
        self.without.iter().find(fits)
    }

    /// Lines of `not_enclosed.csv` that match no number of these tables.
    pub fn superfluous<'a>(&self, tables: impl IntoIterator<Item = &'a GoldenTable>) -> Vec<String> {
        let lines = tables.into_iter().flat_map(|table| table.lines.iter().map(move |line| (table, line)));
        let used: Vec<_> = lines.filter_map(|(table, line)| self.reason(table, line)).collect();
        self.without.iter().filter(|row| !used.contains(row)).map(|row| row.join(",")).collect()
    }

    /// Number of enclosures.
    pub fn count(&self) -> usize {
        self.ends.len()
    }
}

/// The rows of a table after its header, each of `N` columns.
fn rows<const N: usize>(text: &str) -> Result<Vec<[String; N]>, String> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let row = |record: csv::StringRecord| {
        let columns: Vec<String> = record.iter().map(str::to_owned).collect();
        columns.try_into().map_err(|columns| format!("{columns:?} has not {N} columns"))
    };
    reader.records().map(|record| record.map_err(|error| error.to_string()).and_then(row)).collect()
}

/// Whether all numbers of `[lower, upper]` round to the printed one.
pub fn rounds_to(printed: &str, lower: f64, upper: f64) -> bool {
    let within = |from: f64, to: f64| from <= lower && lower <= upper && upper <= to;
    let Some((mantissa, exponent)) = printed.split_once('e') else {
        // A number below 1e-15 is written as `0`.
        return printed == "0" && within(-1e-15, 1e-15);
    };
    let decimals = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len() as i32);
    let (Ok(value), Ok(exponent)) = (printed.parse::<f64>(), exponent.parse::<i32>()) else { return false };
    let half_unit = 0.5 * 10f64.powi(exponent - decimals);
    // The interval is narrowed by the rounding of its ends.
    let slack = 4.0 * f64::EPSILON * value.abs();
    within(value - half_unit + slack, value + half_unit - slack)
}
