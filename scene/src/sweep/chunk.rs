//! Rows of consecutive scenes.

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::Sweep;

/// The rows of a chunk as written in the tables.
#[derive(Debug, Default)]
pub(super) struct ChunkText {
    pub(super) rows: Vec<u8>,
    pub(super) errors: Vec<u8>,
    pub(super) failed: u64,
}

/// The result of `compute`. A defect that panics costs its own row, but not the sweep, which would otherwise panic again at
/// every restart.
pub(super) fn guarded<T>(compute: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(compute)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
        Err(format!("a bug in this program: {}", text.unwrap_or("it panicked")))
    })
}

/// The fields with which the row of a scene begins: its number and its parameters.
pub(super) fn start_of_row(number: u64, parameters: &[f64]) -> impl Iterator<Item = String> {
    [number.to_string()].into_iter().chain(parameters.iter().map(|x| format!("{x:?}")))
}

const MEMORY: &str = "a table in memory takes every row";

/// Computes the scenes `numbers` and writes their rows. A scene that cannot be computed also gets a row.
pub(super) fn chunk_text(sweep: &Sweep<'_>, numbers: Range<u64>) -> ChunkText {
    let columns = sweep.outputs.header(&sweep.units).len();
    let (mut rows, mut errors) = (csv::Writer::from_writer(Vec::new()), csv::Writer::from_writer(Vec::new()));
    let mut text = ChunkText::default();
    let parameters: Vec<_> = numbers.clone().map(|number| sweep.parameters.of_scene(number)).collect();
    let made: Vec<_> = parameters.iter().map(|parameters| guarded(|| sweep.scene_with(parameters))).collect();
    let scenes: Vec<_> = made.iter().filter_map(|scene| scene.as_ref().ok()).collect();
    let mut values = sweep.outputs.values(&scenes).into_iter();
    for ((number, parameters), scene) in numbers.zip(&parameters).zip(&made) {
        // The numbers of the outputs, NaN for one that does not exist, or the reason why there are none.
        let outcome = match scene {
            Ok(_) => values.next().expect("as many results as scenes"),
            Err(why) => Err(why.clone()),
        };
        let start = || start_of_row(number, parameters);
        let status = if outcome.is_ok() { "ok" } else { "failed" };
        start().chain([status.to_owned()]).try_for_each(|field| rows.write_field(field)).expect(MEMORY);
        let missing = || vec![f64::NAN; columns];
        for value in outcome.as_ref().map_or_else(|_| missing(), Clone::clone) {
            rows.write_field(if value.is_nan() { String::new() } else { format!("{value:?}") }).expect(MEMORY);
        }
        rows.write_record(None::<&[u8]>).expect(MEMORY);
        if let Err(why) = outcome {
            errors.write_record(start().chain([why])).expect(MEMORY);
            text.failed += 1;
        }
    }
    (text.rows, text.errors) = (rows.into_inner().expect(MEMORY), errors.into_inner().expect(MEMORY));
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_of_its_row() {
        let found: Result<(), _> = guarded(|| panic!("deliberately, in a test"));
        assert_eq!(found, Err("a bug in this program: deliberately, in a test".to_owned()));
        assert_eq!(guarded(|| Ok(3)), Ok(3));
    }
}
