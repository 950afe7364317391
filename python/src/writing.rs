//! Work that writes a table: without Python's lock, with progress, and stopped by Ctrl-C.

use std::io::{self, Write};
use std::sync::OnceLock;
use std::time::Instant;

use pyo3::prelude::*;
use twofold_scene::trajectory::TrajectoryError;

use crate::error::raised;
use crate::interrupt::LOOKED_EVERY;
use crate::table::Table;

/// Parts of the work between two calls of `progress`.
const STEP: f64 = 0.01;

/// What is written, unless there is a reason to stop.
struct Writing<'s> {
    bytes: Vec<u8>,
    stopped: &'s OnceLock<PyErr>,
}

impl Write for Writing<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.bytes.extend_from_slice(bytes);
        if self.stopped.get().is_some() { Err(io::ErrorKind::Other.into()) } else { Ok(bytes.len()) }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The table that `write` writes. `progress` is called with the part that is done, from 0 to 1; its error stops the work.
pub fn written<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    write: impl FnOnce(&mut dyn Write, &mut dyn FnMut(f64)) -> Result<T, TrajectoryError> + Send,
) -> PyResult<Table> {
    let stopped = OnceLock::new();
    let mut writing = Writing { bytes: Vec::new(), stopped: &stopped };
    let (mut told, mut looked) = (-STEP, Instant::now());
    let result = py.detach(|| {
        let mut tell = |part: f64| {
            if looked.elapsed() >= LOOKED_EVERY {
                looked = Instant::now();
                if let Err(signal) = Python::attach(|py| py.check_signals()) {
                    let _ = stopped.set(signal);
                }
            }
            let Some(progress) = progress.as_ref().filter(|_| part >= told + STEP && stopped.get().is_none()) else {
                return;
            };
            told = part;
            if let Err(error) = Python::attach(|py| progress.call1(py, (part,))) {
                let _ = stopped.set(error);
            }
        };
        write(&mut writing, &mut tell)
    });
    let bytes = writing.bytes;
    if let Some(error) = stopped.into_inner() {
        return Err(error);
    }
    result.map_err(raised)?;
    if let Some(progress) = progress.filter(|_| told < 1.0) {
        progress.call1(py, (1.0,))?;
    }
    Table::of_csv(bytes).map_err(raised)
}
