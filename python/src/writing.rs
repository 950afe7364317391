//! Work that writes a table: without Python's lock, with progress, and stopped by Ctrl-C.

use std::io::{self, Write};

use pyo3::prelude::*;
use twofold_scene::trajectory::TrajectoryError;

use crate::error::raised;
use crate::table::Table;

/// Bytes written between two looks for Ctrl-C.
const BYTES_AT_ONCE: usize = 1 << 16;

/// Parts of the work between two calls of `progress`.
const STEP: f64 = 0.01;

/// What is written, and why to stop.
struct Writing {
    bytes: Vec<u8>,
    looked: usize,
    stopped: Option<PyErr>,
}

impl Write for Writing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.bytes.extend_from_slice(bytes);
        if self.stopped.is_none() && self.bytes.len() - self.looked > BYTES_AT_ONCE {
            self.looked = self.bytes.len();
            self.stopped = Python::attach(|py| py.check_signals()).err();
        }
        if self.stopped.is_some() { Err(io::ErrorKind::Other.into()) } else { Ok(bytes.len()) }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The table that `write` writes, and what it returns. `progress` is called with the part that is done, from 0 to 1.
pub fn written<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    write: impl FnOnce(&mut dyn Write, &mut dyn FnMut(f64)) -> Result<T, TrajectoryError> + Send,
) -> PyResult<(Table, T)> {
    let mut writing = Writing { bytes: Vec::new(), looked: 0, stopped: None };
    let mut failed = None;
    let result = py.detach(|| {
        let mut told = -STEP;
        let mut tell = |part: f64| {
            let Some(progress) = progress.as_ref().filter(|_| part >= told + STEP && failed.is_none()) else { return };
            told = part;
            failed = Python::attach(|py| progress.call1(py, (part,)).err());
        };
        write(&mut writing, &mut tell)
    });
    if let Some(error) = writing.stopped.or(failed) {
        return Err(error);
    }
    let found = result.map_err(raised)?;
    Ok((Table::of_csv(writing.bytes).map_err(raised)?, found))
}
