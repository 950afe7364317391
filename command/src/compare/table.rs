//! Reading the authors' files: numbers in columns, separated by tabs or spaces, without a header.

use std::fs::{self, File};
use std::path::Path;

use super::known::KnownFile;
use twofold_scene::scene_file::shortened;
use twofold_scene::text_file::read_text;

/// Latest time in a file, in t_c; the published ones end at 1000.
const LATEST_TIME: f64 = 1100.0;

/// The numbers of a file by rows; the first of each row is a time.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) rows: Vec<Vec<f64>>,
}

impl Table {
    pub(super) fn times(&self) -> impl Iterator<Item = f64> {
        self.rows.iter().map(|row| row[0])
    }

    pub(super) fn last_time(&self) -> f64 {
        self.rows.last().expect("a table that is read has rows")[0]
    }
}

/// Reads and checks a known file. A refusal names the file and, if possible, line and column.
pub(super) fn read(path: &Path, known: &KnownFile) -> Result<Table, String> {
    let name = path.display().to_string();
    let refuse = |message: String| format!("{name}: {message}");
    if path.is_dir() {
        return Err(refuse("is a directory, not a file of numbers".into()));
    }
    // Opening a pipe or a device may wait for ever.
    if fs::metadata(path).is_ok_and(|found| !found.is_file()) {
        return Err(refuse("is not a regular file".into()));
    }
    let file = File::open(path).map_err(|error| refuse(format!("cannot be opened: {error}")))?;
    parse(&name, &read_text(file).map_err(refuse)?, known)
}

pub(super) fn parse(file: &str, text: &str, known: &KnownFile) -> Result<Table, String> {
    let fault = |line: usize, column: usize, message: String| Err(format!("{file}:{line}:{column}: {message}"));
    // Without the mark with which some programs begin a text, and blank lines at the end.
    let text = text.trim_start_matches('\u{feff}').trim_end_matches([' ', '\t', '\r', '\n']);
    let (rows_wanted, columns) = (known.rows, known.columns());
    let width = columns.len() + 1;
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut last_line = 0;
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        last_line = line;
        if rows.len() == rows_wanted {
            return fault(line, 1, format!("too many rows; the published file has {rows_wanted}"));
        }
        let mut row = Vec::with_capacity(width);
        for word in words(content) {
            if row.len() == width {
                let names = std::iter::once("t").chain(columns.iter().map(|column| column.name));
                let names = names.collect::<Vec<_>>().join(", ");
                return fault(
                    line,
                    column_of(word, content),
                    format!("too many columns; the published file has {width} ({names})"),
                );
            }
            match word.parse::<f64>() {
                Ok(value) if value.is_finite() => row.push(value),
                _ => {
                    let message = format!("`{}` is not a finite decimal number", shortened(word));
                    return fault(line, column_of(word, content), message);
                }
            }
        }
        let end = content.chars().count() + 1;
        if row.len() < width {
            let why = if row.is_empty() { "the line is empty" } else { "the row is incomplete" };
            return fault(line, end, format!("{why}; found {} of {width} numbers", row.len()));
        }
        let time = row[0];
        let start = column_of(words(content).next().expect("a row of numbers"), content);
        if !(0.0..=LATEST_TIME).contains(&time) {
            return fault(line, start, format!("time {time:?}: must be from 0 to {LATEST_TIME} t_c"));
        }
        if let Some(before) = rows.last().map(|row| row[0]).filter(|&before| time <= before) {
            return fault(line, start, format!("time {time:?} after {before:?}; times must increase"));
        }
        rows.push(row);
    }
    if rows.is_empty() {
        return Err(format!("{file}: is empty"));
    }
    if rows.len() < rows_wanted {
        let end = text.lines().last().expect("there are rows").chars().count() + 1;
        let message = format!("the file is incomplete; expected {rows_wanted} rows, found {}", rows.len());
        return fault(last_line, end, message);
    }
    Ok(Table { rows })
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split([' ', '\t', '\r']).filter(|word| !word.is_empty())
}

/// The column, counted from one, at which a word of a line begins.
fn column_of(word: &str, line: &str) -> usize {
    let before = word.as_ptr().addr() - line.as_ptr().addr();
    line[..before].chars().count() + 1
}

#[cfg(test)]
mod tests {
    use super::super::known::KNOWN;
    use super::*;

    #[test]
    fn a_fault_is_told_with_its_place() {
        let known = KNOWN.iter().find(|file| file.name == "mntp1_pset.dat").expect("it is known");
        let known = KnownFile { rows: 2, ..*known };
        let table = parse("x.dat", "0 2\n1100\t-4e-1\n", &known).expect("two rows");
        assert_eq!((&table.rows, table.last_time()), (&vec![vec![0.0, 2.0], vec![1100.0, -0.4]], 1100.0));
        let ended = parse("x.dat", "\u{feff}0 2\r\n1100\t-4e-1\r\n\r\n \n", &known).expect("two rows");
        assert_eq!(ended.rows, table.rows);
        for (text, fault) in [
            ("", "x.dat: is empty"),
            ("\n", "x.dat: is empty"),
            ("1 2\n", "x.dat:1:4: the file is incomplete; expected 2 rows, found 1"),
            ("1 2\n\n3 4\n", "x.dat:2:1: the line is empty; found 0 of 2 numbers"),
            ("1 2\n3\n", "x.dat:2:2: the row is incomplete; found 1 of 2 numbers"),
            ("1 2  9\n", "x.dat:1:6: too many columns; the published file has 2 (t, period)"),
            ("1 2\n3 4\n5 6\n", "x.dat:3:1: too many rows; the published file has 2"),
            (" -1 2\n", "x.dat:1:2: time -1.0: must be from 0 to 1100 t_c"),
            ("1 2\n1100.5 4\n", "x.dat:2:1: time 1100.5: must be from 0 to 1100 t_c"),
            ("1 2\n1 4\n", "x.dat:2:1: time 1.0 after 1.0; times must increase"),
            ("1 two\n", "x.dat:1:3: `two` is not a finite decimal number"),
            ("1 2\u{c}\n", "x.dat:1:3: `2` is not a finite decimal number"),
            ("1 inf\n", "x.dat:1:3: `inf` is not a finite decimal number"),
        ] {
            assert_eq!(parse("x.dat", text, &known).expect_err(text), fault);
        }
    }
}
