//! Merges the tables of all shards into one.

use std::io::{self, BufRead, Write};

use super::Sweep;
use super::chunk::start_of_row;

/// Writes the rows of `parts`, named tables, under one header; together they must be all scenes of the sweep, in order.
pub fn merge(
    sweep: &Sweep<'_>,
    parts: &mut [(String, Box<dyn BufRead>)],
    mut writer: impl Write,
) -> Result<(), String> {
    let mut write = |bytes: &[u8]| writer.write_all(bytes).map_err(|error| format!("the table: {error}"));
    let header = csv_line(&sweep.header());
    write(&header)?;
    let mut next = 0;
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
        while read(&mut line)? > 0 {
            let number = line.split(|byte| *byte == b',').next().unwrap_or(&[]);
            let number = std::str::from_utf8(number).ok().and_then(|number| number.parse::<u64>().ok());
            if number != Some(next) || !line.ends_with(b"\n") {
                let found = number.map_or("a line that is not a row".to_owned(), |number| format!("scene {number}"));
                return Err(not_next(format!("has {found} where scene {next} is expected")));
            }
            let start: Vec<_> = start_of_row(next, &sweep.parameters.of_scene(next)).collect();
            if !line.starts_with(format!("{},", start.join(",")).as_bytes()) {
                return Err(not_next(format!("is of another sweep: its scene {next} has other parameters")));
            }
            write(&line)?;
            next += 1;
        }
    }
    if next != sweep.scenes {
        let part = parts.last().map_or("", |(part, _)| part);
        return Err(format!("{part} is the last and ends before scene {next}: the sweep has {}", sweep.scenes));
    }
    Ok(())
}

/// Writes the errors in the table `part`, whose scenes must be those of the sweep.
pub fn merge_errors(sweep: &Sweep<'_>, part: &str, table: impl BufRead, writer: impl Write) -> Result<(), String> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(table);
    let mut writer = csv::Writer::from_writer(writer);
    let read = |error: csv::Error| format!("{part}: {error}");
    let mut records = reader.records();
    if !records.next().transpose().map_err(read)?.is_some_and(|header| header.iter().eq(sweep.errors_header())) {
        return Err(format!("{part} does not begin with the header of this sweep's errors"));
    }
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
    }
    writer.flush().map_err(|error| format!("the table of errors: {error}"))
}

/// A line of a table.
pub fn csv_line(fields: &[String]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(fields).expect("memory takes a record");
    writer.into_inner().expect("memory takes a record")
}
