//! Writing a table: without Python's lock, with progress, and stopped by Ctrl-C.

use std::io::{self, Write};
use std::time::Instant;

use pyo3::prelude::*;
use twofold_scene::trajectory::TrajectoryError;

use crate::error::raised;
use crate::interrupt::LOOKED_EVERY;
use crate::table::Table;

/// Fraction of the work between two calls of `progress`.
const STEP: f64 = 0.01;

/// The table written by `write`. `progress` is called with the completed fraction, from 0 to 1; an error in it stops the work.
pub fn written<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    write: impl FnOnce(&mut dyn Write, &mut dyn FnMut(f64) -> io::Result<()>) -> Result<T, TrajectoryError> + Send,
) -> PyResult<Table> {
    let (mut bytes, mut stopped) = (Vec::new(), None);
    let (mut told, mut looked) = (-STEP, Instant::now());
    let result = py.detach(|| {
        let mut tell = |part: f64| {
            let mut outcome = Ok(());
            if looked.elapsed() >= LOOKED_EVERY {
                looked = Instant::now();
                outcome = Python::attach(|py| py.check_signals());
            }
            if let Some(progress) = progress.as_ref().filter(|_| part >= told + STEP && outcome.is_ok()) {
                told = part;
                outcome = Python::attach(|py| progress.call1(py, (part,)).map(drop));
            }
            outcome.map_err(|error| {
                stopped = Some(error);
                io::ErrorKind::Other.into()
            })
        };
        write(&mut bytes, &mut tell)
    });
    if let Some(error) = stopped {
        return Err(error);
    }
    result.map_err(raised)?;
    if let Some(progress) = progress.filter(|_| told < 1.0) {
        progress.call1(py, (1.0,))?;
    }
    Table::of_csv(bytes).map_err(raised)
}
