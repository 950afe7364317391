//! Merges the tables of all shards into one.

use std::io::{self, BufRead, Write};

use super::Sweep;
use super::chunk::start_of_row;
use crate::scene_file::counted;

/// Writes the rows of `parts`, named tables, under one header; together they must be all scenes of the sweep, in order. The first and the
/// last row of each part that have numbers are computed again. Returns how many rows of each part are `failed`.
pub fn merge(
    sweep: &Sweep<'_>,
    parts: &mut [(String, Box<dyn BufRead>)],
    mut writer: impl Write,
) -> Result<Vec<u64>, String> {
    let mut write = |bytes: &[u8]| writer.write_all(bytes).map_err(|error| format!("the table: {error}"));
    let names = sweep.header();
    let header = csv_line(&names);
    write(&header)?;
    let (mut next, mut all_failed) = (0, Vec::new());
    for (part, reader) in &mut *parts {
        let not_next = |why: String| format!("{part} {why}");
        let mut line = Vec::new();
        let mut read = |line: &mut Vec<u8>| {
            line.clear();
            reader.read_until(b'\n', line).map_err(|error: io::Error| format!("{part}: {error}"))
        };
        read(&mut line)?;
        if line != header {
            return Err(not_next("does not begin with the header of this sweep's table".into()));
        }
        let (mut failed, mut samples) = (0, Vec::new());
        while read(&mut line)? > 0 {
            let number = line.split(|byte| *byte == b',').next().unwrap_or(&[]);
            let number = std::str::from_utf8(number).ok().and_then(|number| number.parse::<u64>().ok());
            if number != Some(next) {
                let found = number.map_or("a line that is not a row".to_owned(), |number| format!("scene {number}"));
                return Err(not_next(format!("has {found} where scene {next} is expected")));
            }
            if !line.ends_with(b"\n") {
                return Err(not_next(format!("ends within the row of scene {next}")));
            }
            let start: Vec<_> = start_of_row(next, &sweep.parameters.of_scene(next)).collect();
            if !line.starts_with(format!("{},", start.join(",")).as_bytes()) {
                return Err(not_next(format!("is of another sweep: its scene {next} has other parameters")));
            }
            if is_failed(&names, start.len(), &line)
                .map_err(|why| not_next(format!("has a scene {next} with {why}")))?
            {
                failed += 1;
            } else {
                samples.truncate(1);
                samples.push((next, line.clone()));
            }
            write(&line)?;
            next += 1;
        }
        for (number, row) in samples {
            if sweep.rows(number..number + 1).0[0] != row {
                let why = "has other numbers here; the parts must be of this scene, tolerance and method, and merged where they were computed";
                return Err(not_next(format!("is of another sweep: its scene {number} {why}")));
            }
        }
        all_failed.push(failed);
    }
    if next != sweep.scenes {
        let part = parts.last().map_or("", |(part, _)| part);
        return Err(format!("{part} is the last and ends before scene {next}; the sweep has {} scenes", sweep.scenes));
    }
    Ok(all_failed)
}

/// Whether a row says that its scene failed; an error if it is not one that a sweep writes under these names, with the status in field `status`.
fn is_failed(names: &[String], status: usize, row: &[u8]) -> Result<bool, String> {
    let row = String::from_utf8_lossy(row);
    let fields: Vec<_> = row.trim_end_matches('\n').split(',').collect();
    if fields.len() != names.len() {
        return Err(format!("{}: must be {}", counted(fields.len(), "field"), names.len()));
    }
    let (is_failed, allowed) = match fields[status] {
        "ok" => (false, "a number or empty"),
        "failed" => (true, "empty, since the scene failed"),
        other => return Err(format!("the status `{other}`: must be ok or failed")),
    };
    let is_wrong = |field: &str| !field.is_empty() && (is_failed || field.parse::<f64>().is_err());
    match (status + 1..fields.len()).find(|&i| is_wrong(fields[i])) {
        Some(i) => Err(format!("`{}` = `{}`: must be {allowed}", names[i], fields[i])),
        None => Ok(is_failed),
    }
}

/// Writes the errors in the table `part`, whose scenes must be those of the sweep; there must be one for each row of its table that `failed`.
pub fn merge_errors(
    sweep: &Sweep<'_>,
    part: &str,
    failed: u64,
    table: impl BufRead,
    writer: impl Write,
) -> Result<(), String> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(table);
    let mut writer = csv::Writer::from_writer(writer);
    let read = |error: csv::Error| format!("{part}: {error}");
    let mut records = reader.records();
    if !records.next().transpose().map_err(read)?.is_some_and(|header| header.iter().eq(sweep.errors_header())) {
        return Err(format!("{part} does not begin with the header of this sweep's errors"));
    }
    let mut count = 0;
    for record in records {
        let record = record.map_err(read)?;
        let number =
            record.get(0).and_then(|number| number.parse::<u64>().ok()).filter(|number| *number < sweep.scenes);
        let number =
            number.ok_or_else(|| format!("{part} has a line that is not an error of a scene of this sweep"))?;
        let parameters = sweep.parameters.of_scene(number);
        if !start_of_row(number, &parameters).zip(&record).all(|(ours, theirs)| ours == theirs) {
            return Err(format!("{part} is of another sweep: its scene {number} has other parameters"));
        }
        writer.write_record(&record).map_err(|error| format!("the table of errors: {error}"))?;
        count += 1;
    }
    if count != failed {
        let rows = counted(count, "row");
        return Err(format!("{part} has {rows}: must be {failed}, one for each scene that failed"));
    }
    writer.flush().map_err(|error| format!("the table of errors: {error}"))
}

/// A line of a table.
pub fn csv_line(fields: &[String]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(fields).expect("memory takes a record");
    writer.into_inner().expect("memory takes a record")
}
