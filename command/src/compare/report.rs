//! A comparison as text and as JSON.

use std::fmt::Write as _;

use serde_json::json;

use super::{ColumnDifference, ComparedFile, Comparison, Verdict};
use crate::text_table::text_table;

impl Verdict {
    fn name(self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::Differs => "DIFFERS",
            Verdict::NotJudged => "not judged",
        }
    }
}

/// A table of the largest differences, the allowed ones with their reasons, and the files that were not read.
pub fn text(comparison: &Comparison) -> String {
    let mut reasons: Vec<&str> = Vec::new();
    let header =
        ["file", "rows", "started from", "column", "largest difference", "at t [t_c]", "allowed", "", "verdict"];
    let mut table = vec![header.map(String::from).to_vec()];
    for file in &comparison.files {
        for (i, column) in file.columns.iter().enumerate() {
            let number = reasons.iter().position(|reason| *reason == column.reason).unwrap_or_else(|| {
                reasons.push(column.reason);
                reasons.len() - 1
            });
            let first = |text: &str| if i == 0 { text.to_owned() } else { String::new() };
            table.push(vec![
                first(file.file),
                first(&file.rows.to_string()),
                first(&file.start),
                column.column.clone(),
                format!("{:.2e} {}", column.difference, if column.unit == "1" { "" } else { column.unit }),
                format!("{:.3}", column.time),
                column.allowed.map_or("-".into(), |allowed| format!("{allowed:.3e}")),
                format!("[{}]", number + 1),
                column.verdict.name().to_owned(),
            ]);
        }
    }
    let mut text = format!("{}\n\n", text_table(&table, |column| [1, 5, 6].contains(&column), true));
    for (i, reason) in reasons.iter().enumerate() {
        let _ = writeln!(text, "[{}] {reason}", i + 1);
    }
    for file in &comparison.files {
        for note in &file.notes {
            let _ = writeln!(text, "{}, started from {}: {note}", file.file, file.start);
        }
    }
    if !comparison.absent.is_empty() {
        let _ = writeln!(text, "not in the folder: {}", comparison.absent.join(", "));
    }
    if !comparison.not_read.is_empty() {
        let _ = writeln!(text, "not read, since their names are not known: {}", comparison.not_read.join(", "));
    }
    let all = comparison.files.iter().flat_map(|file| &file.columns);
    let count = |verdict| all.clone().filter(|column| column.verdict == verdict).count();
    let (agree, differ, open) = (count(Verdict::Agrees), count(Verdict::Differs), count(Verdict::NotJudged));
    let differ = match differ {
        0 => "none differs".to_owned(),
        1 => "1 DIFFERS".to_owned(),
        _ => format!("{differ} DIFFER"),
    };
    let agreeing = if agree == 1 { "column agrees" } else { "columns agree" };
    let _ = write!(text, "{agree} {agreeing}, {differ}, {open} not judged");
    text
}

pub fn json(comparison: &Comparison) -> String {
    let finite = |x: f64| if x.is_finite() { json!(x) } else { json!(null) };
    let column = |column: &ColumnDifference| {
        json!({
            "column": column.column,
            "unit": column.unit,
            "largest_difference": finite(column.difference),
            "at": finite(column.time),
            "allowed": column.allowed,
            "reason": column.reason,
            "verdict": column.verdict.name().to_lowercase(),
        })
    };
    let file = |file: &ComparedFile| {
        json!({
            "file": file.file,
            "rows": file.rows,
            "started_from": file.start,
            "columns": file.columns.iter().map(column).collect::<Vec<_>>(),
            "notes": file.notes,
        })
    };
    let whole = json!({
        "folder": comparison.folder,
        "files": comparison.files.iter().map(file).collect::<Vec<_>>(),
        "absent": comparison.absent,
        "not_read": comparison.not_read,
        "differing": comparison.differing(),
    });
    serde_json::to_string_pretty(&whole).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text_table::cells;

    fn column(column: &str, reason: &'static str, verdict: Verdict) -> ColumnDifference {
        let (difference, time, allowed) = (1.25e-3, 17.5, Some(2e-3));
        ColumnDifference { column: column.to_owned(), unit: "rad", difference, time, allowed, reason, verdict }
    }

    fn file(file: &'static str, columns: Vec<ColumnDifference>) -> ComparedFile {
        ComparedFile { file, start: "Eq. (34)".into(), rows: 7, columns, notes: Vec::new() }
    }

    #[test]
    fn reasons_are_told_once_and_verdicts_counted() {
        use Verdict::{Agrees, Differs, NotJudged};
        let files = vec![
            file("a.dat", vec![column("alpha", "by A", Agrees), column("beta", "by B", Differs)]),
            file("b.dat", vec![column("gamma", "by A", NotJudged)]),
        ];
        let comparison = Comparison { folder: "x".into(), files, absent: vec!["c.dat"], not_read: Vec::new() };
        let text = text(&comparison);
        let found = cells(&text);
        let numbers = ["1.25e-3 rad", "17.500", "2.000e-3"];
        let row = |before: &[&'static str], after: &[&'static str]| [before, &numbers, after].concat();
        assert_eq!(found[1], row(&["a.dat", "7", "Eq. (34)", "alpha"], &["[1]", "agrees"]), "{text}");
        assert_eq!(found[2], row(&["beta"], &["[2]", "DIFFERS"]), "{text}");
        assert_eq!(found[3], row(&["b.dat", "7", "Eq. (34)", "gamma"], &["[1]", "not judged"]), "{text}");
        let end = "\n\n[1] by A\n[2] by B\nnot in the folder: c.dat\n1 column agrees, 1 DIFFERS, 1 not judged";
        assert!(text.ends_with(end), "{text}");
    }
}
