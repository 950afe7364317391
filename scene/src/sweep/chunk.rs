//! Rows of consecutive scenes.

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::Sweep;

/// One scene of the sweep with what was found.
pub(super) struct Row {
    number: u64,
    parameters: Vec<f64>,
    /// The numbers of the outputs, not a number where one does not exist, or why there are none.
    outcome: Result<Vec<f64>, String>,
}

/// The rows of a chunk as they stand in the tables.
#[derive(Debug, Default)]
pub(super) struct ChunkText {
    pub(super) rows: Vec<u8>,
    pub(super) errors: Vec<u8>,
    pub(super) failed: u64,
}

/// Computes the scenes of a chunk. A scene that cannot be computed is a row too.
fn evaluate_chunk(sweep: &Sweep<'_>, numbers: Range<u64>) -> Vec<Row> {
    let made = |number| {
        let parameters = sweep.parameters.of_scene(number);
        let scene = guarded(|| sweep.scene(&parameters));
        (number, parameters, scene)
    };
    let made: Vec<_> = numbers.map(made).collect();
    let scenes: Vec<_> = made.iter().filter_map(|(_, _, scene)| scene.as_ref().ok()).collect();
    let mut values = sweep.outputs.values(&scenes).into_iter();
    let row = |(number, parameters, scene): (u64, Vec<f64>, Result<_, String>)| {
        let outcome = scene.and_then(|_| values.next().expect("as many results as scenes"));
        Row { number, parameters, outcome }
    };
    made.iter()
        .map(|(number, parameters, scene)| {
            (*number, parameters.clone(), scene.as_ref().map(|_| ()).map_err(Clone::clone))
        })
        .map(row)
        .collect()
}

/// What `compute` gives. A defect that panics costs its own row, not the sweep, which would meet it again at every restart.
pub(super) fn guarded<T>(compute: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(compute)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
        Err(format!("a defect of this program: {}", text.unwrap_or("it panicked")))
    })
}

/// Computes the scenes `numbers` and writes their rows.
pub(super) fn chunk_text(sweep: &Sweep<'_>, numbers: Range<u64>) -> Result<ChunkText, csv::Error> {
    let columns = sweep.outputs.header(&sweep.units).len();
    let (mut rows, mut errors) = (csv::Writer::from_writer(Vec::new()), csv::Writer::from_writer(Vec::new()));
    let mut text = ChunkText::default();
    for row in evaluate_chunk(sweep, numbers) {
        let start = || [row.number.to_string()].into_iter().chain(row.parameters.iter().map(|x| format!("{x:?}")));
        let status = if row.outcome.is_ok() { "ok" } else { "failed" };
        start().chain([status.to_owned()]).try_for_each(|field| rows.write_field(field))?;
        let missing = || vec![f64::NAN; columns];
        for value in row.outcome.as_ref().map_or_else(|_| missing(), Clone::clone) {
            rows.write_field(if value.is_nan() { String::new() } else { format!("{value:?}") })?;
        }
        rows.write_record(None::<&[u8]>)?;
        if let Err(why) = row.outcome {
            errors.write_record(start().chain([why]))?;
            text.failed += 1;
        }
    }
    let whole =
        |writer: csv::Writer<Vec<u8>>| writer.into_inner().map_err(|error| csv::Error::from(error.into_error()));
    (text.rows, text.errors) = (whole(rows)?, whole(errors)?);
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_of_its_row() {
        let found: Result<(), _> = guarded(|| panic!("deliberately, in a test"));
        assert_eq!(found, Err("a defect of this program: deliberately, in a test".to_owned()));
        assert_eq!(guarded(|| Ok(3)), Ok(3));
    }
}
