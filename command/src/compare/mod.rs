//! The authors' published data compared with the same numbers computed here.

mod allowed;
mod known;
mod recompute;
mod report;
mod series;
mod table;

use std::fs;
use std::path::Path;

use allowed::{Allowed, allowed};
use known::{Content, KNOWN, KnownFile};
pub use report::{json, text};
use table::Table;

use self::recompute::Scales;
use crate::commands::Failure;
use twofold_scene::scene_file::nearest;
use twofold_verify::paper_examples::{PaperExample, paper_examples};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    Agrees,
    /// It differs by more, or is not a number.
    Differs,
    /// There is no known error to judge the difference.
    NotJudged,
}

#[derive(Debug, Clone)]
pub struct ColumnDifference {
    pub column: String,
    pub unit: &'static str,
    pub difference: f64,
    /// Time of the row with the largest difference, in t_c.
    pub time: f64,
    /// The allowed difference.
    pub allowed: Option<f64>,
    /// Its reason, or the reason why there is none.
    pub reason: &'static str,
    pub verdict: Verdict,
}

#[derive(Debug, Clone)]
pub struct ComparedFile {
    pub file: &'static str,
    /// Initial values of the motion computed here.
    pub start: String,
    pub rows: usize,
    pub columns: Vec<ColumnDifference>,
    /// Further observations.
    pub notes: Vec<String>,
}

#[derive(Debug, Clone)]
pub struct Comparison {
    pub folder: String,
    /// Compared files, in the order of the known names; the series of periods and widths appear twice.
    pub files: Vec<ComparedFile>,
    /// Known names that are not in the folder.
    pub absent: Vec<&'static str>,
    /// Other files in the folder, which are not read.
    pub not_read: Vec<String>,
}

impl Comparison {
    pub fn differing(&self) -> Vec<&'static str> {
        let differs = |file: &&ComparedFile| file.columns.iter().any(|column| column.verdict == Verdict::Differs);
        self.files.iter().filter(differs).map(|file| file.file).collect()
    }
}

/// Compares every known file in `folder`. All are read and checked before anything is computed.
pub fn compare(folder: &Path) -> Result<Comparison, Failure> {
    let input = Failure::BadInput;
    let shown = folder.display();
    let entries =
        fs::read_dir(folder).map_err(|error| input(format!("{shown}: cannot be read as a folder: {error}")))?;
    let mut names = Vec::new();
    for entry in entries {
        let entry = entry.map_err(|error| input(format!("{shown}: cannot be listed: {error}")))?;
        names.push(entry.file_name().to_string_lossy().into_owned());
    }
    names.sort();
    let known_names: Vec<_> = KNOWN.iter().map(|known| known.name).collect();
    let (found, absent): (Vec<_>, Vec<_>) = KNOWN.iter().partition(|known| names.iter().any(|name| name == known.name));
    if found.is_empty() {
        let near = names.iter().find_map(|name| Some((name, nearest(name, &known_names)?)));
        let guess = near.map(|(name, near)| format!("; should `{name}` be `{near}`?")).unwrap_or_default();
        return Err(input(format!("{shown}: contains none of the authors' files {}{guess}", known_names.join(", "))));
    }
    let tables: Vec<_> = found.iter().map(|known| table::read(&folder.join(known.name), known)).collect();
    let faults: Vec<_> = tables.iter().filter_map(|table| table.as_ref().err().cloned()).collect();
    if !faults.is_empty() {
        return Err(input(faults.join("\n")));
    }
    let mut files = Vec::new();
    for (known, table) in found.iter().zip(tables.into_iter().flatten()) {
        let motion = |error| Failure::Failed(format!("a motion could not be computed: {error}"));
        files.extend(compare_file(known, &table).map_err(motion)?);
    }
    Ok(Comparison {
        folder: shown.to_string(),
        files,
        absent: absent.iter().map(|known| known.name).collect(),
        not_read: names.into_iter().filter(|name| !known_names.contains(&name.as_str())).collect(),
    })
}

/// The comparison of `text` with the rows of a known file, which must have exactly the first `rows` of them. For fuzzing:
/// every outcome but a panic is allowed.
#[cfg(any(test, feature = "fuzzing"))]
pub(crate) fn compare_text(kind: usize, text: &str, rows: usize) -> Option<Result<String, String>> {
    static SHORT: std::sync::OnceLock<Vec<KnownFile>> = std::sync::OnceLock::new();
    const LONGEST: usize = 16;
    let short = SHORT.get_or_init(|| {
        let with = |known: &KnownFile, rows| KnownFile { rows, ..*known };
        KNOWN.iter().flat_map(|known| (1..=LONGEST).map(move |rows| with(known, rows))).collect()
    });
    let known = short.get(kind.checked_mul(LONGEST)?.checked_add(rows.checked_sub(1)?)?)?;
    let compared = table::parse(known.name, text, known).and_then(|table| {
        let files = compare_file(known, &table).map_err(|error| error.to_string())?;
        Ok(Comparison { folder: String::new(), files, absent: Vec::new(), not_read: Vec::new() })
    });
    Some(compared.map(|comparison| report::text(&comparison) + &report::json(&comparison)))
}

fn compare_file(known: &'static KnownFile, table: &Table) -> Result<Vec<ComparedFile>, twofold::Error> {
    let example = example(known.example);
    match known.content {
        Content::Angles => {
            let (rows, scales) = recompute::angles(&example, table)?;
            Ok(vec![by_rows(known, table, &rows, Some(&scales))])
        }
        Content::Signal => Ok(vec![by_rows(known, table, &recompute::signal(&example, table)?, None)]),
        Content::Waves => Ok(vec![by_rows(known, table, &recompute::waves(&example, table)?, None)]),
        Content::Periods | Content::Widths => series::by_stamps(known, table, &example),
    }
}

fn example(name: &str) -> PaperExample {
    let [first, ..] = paper_examples();
    paper_examples().into_iter().find(|example| example.name == name).unwrap_or(first)
}

fn by_rows(known: &'static KnownFile, table: &Table, ours: &[Vec<f64>], scales: Option<&Scales>) -> ComparedFile {
    let columns = known.columns().into_iter().enumerate().map(|(i, column)| {
        let differences = table.rows.iter().zip(ours).map(|(theirs, ours)| (theirs[0], theirs[i + 1] - ours[i]));
        judged(column.name, column.unit, differences, allowed(known, column.name, scales))
    });
    ComparedFile {
        file: known.name,
        start: "Eq. (34)".into(),
        rows: table.rows.len(),
        columns: columns.collect(),
        notes: Vec::new(),
    }
}

fn judged(
    column: &str,
    unit: &'static str,
    differences: impl Iterator<Item = (f64, f64)>,
    allowed: Allowed,
) -> ColumnDifference {
    let (mut time, mut difference) = (f64::NAN, f64::NEG_INFINITY);
    for (t, d) in differences {
        // NaN counts as the largest.
        let size = if d.is_nan() { f64::INFINITY } else { d.abs() };
        if size > difference {
            (time, difference) = (t, size);
        }
    }
    let verdict = match allowed.limit {
        None => Verdict::NotJudged,
        Some(limit) if difference <= limit => Verdict::Agrees,
        Some(_) => Verdict::Differs,
    };
    let (allowed, reason) = (allowed.limit, allowed.reason);
    ColumnDifference { column: column.to_owned(), unit, difference, time, allowed, reason, verdict }
}

#[cfg(test)]
mod tests {
    use super::{Allowed, Verdict, judged};

    #[test]
    fn what_is_not_a_number_differs() {
        let allowed = Allowed { limit: Some(1.0), reason: "" };
        let found = judged("m.n", "1", [(0.0, 0.5), (1.0, f64::NAN), (2.0, -0.7)].into_iter(), allowed);
        assert_eq!((found.verdict, found.time, found.difference), (Verdict::Differs, 1.0, f64::INFINITY));
    }
}
