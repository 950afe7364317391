//! Sweeps: many scenes, any part of which can be computed anywhere.

use std::path::PathBuf;
use std::sync::Mutex;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use twofold_scene::sweep::{Identity, Spool, SpoolFiles, Sweep as Checked, SweepText, csv_line, errors_beside};

use crate::error::raised;
use crate::interrupt::in_parts;
use crate::pickle::{Reduced, called_with};
use crate::table::Table;

/// Name and text of a sweep file, and name and text of its scene if that is another file.
type Texts = (String, String, Option<(String, String)>);

/// Smallest number of scenes computed together, in the lanes of vector registers.
const TOGETHER: u64 = 8;

/// Many scenes: grids, lists and random draws over the parameters of one (docs/sweep.md). `Sweep("grid.toml")` reads a file, `Sweep(toml=text)` a text.
///
/// A row depends only on its scene: any part can be computed anywhere, in one thread, and the parts together are the table to the byte.
#[pyclass(frozen, module = "twofold._twofold", subclass)]
pub struct Sweep {
    text: SweepText,
    scenes: u64,
    header: Vec<String>,
}

impl Sweep {
    fn of_text(text: SweepText) -> PyResult<Self> {
        let (scenes, header) = {
            let sweep = Checked::new(&text).map_err(raised)?;
            (sweep.scenes, sweep.header())
        };
        Ok(Self { text, scenes, header })
    }
}

#[pymethods]
impl Sweep {
    #[new]
    #[pyo3(signature = (path=None, /, *, toml=None, _texts=None))]
    fn new(
        py: Python<'_>,
        path: Option<&Bound<'_, PyAny>>,
        toml: Option<String>,
        _texts: Option<Texts>,
    ) -> PyResult<Self> {
        // From a pickle.
        if let Some((file, text, scene)) = _texts {
            return Self::of_text(SweepText { file, text, scene });
        }
        let text = match (path, toml) {
            (Some(path), None) => {
                let path: String = py.import("os")?.call_method1("fsdecode", (path,))?.extract()?;
                SweepText::read(&path)
            }
            (None, Some(text)) => SweepText::of("sweep", text),
            _ => return Err(raised("a sweep has one source; give either a path or toml=")),
        };
        Self::of_text(text.map_err(raised)?)
    }

    /// The text of the sweep file.
    #[getter]
    fn toml(&self) -> &str {
        &self.text.text
    }

    /// The line of names at the head of the table, as CSV.
    #[getter]
    fn header<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &csv_line(&self.header))
    }

    /// The rows of the scenes from `start` to before `stop` as CSV, without the header, those of the table of errors, and the number of failed scenes; one thread is used.
    fn rows<'py>(
        &self,
        py: Python<'py>,
        start: u64,
        stop: u64,
    ) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyBytes>, u64)> {
        if !(start <= stop && stop <= self.scenes) {
            let count = self.scenes;
            return Err(raised(format!("scenes {start} to {stop}: must be within 0 to {count}")));
        }
        let sweep = Checked::new(&self.text).map_err(raised)?;
        let [mut rows, mut errors] = [Vec::new(), Vec::new()];
        let mut failed = 0;
        in_parts(py, (stop - start).div_ceil(TOGETHER) as usize, |part| {
            let [first, end] = [part.start, part.end].map(|group| stop.min(start + TOGETHER * group as u64));
            let ([more, more_errors], more_failed) = sweep.rows(first..end);
            rows.extend(more);
            errors.extend(more_errors);
            failed += more_failed;
            Ok::<_, twofold::Error>(())
        })?;
        Ok((PyBytes::new(py, &rows), PyBytes::new(py, &errors), failed))
    }

    /// The table of the scenes from `start` to before `stop`, by one thread; of all if neither is given.
    #[pyo3(signature = (start=0, stop=None))]
    fn run(&self, py: Python<'_>, start: u64, stop: Option<u64>) -> PyResult<Table> {
        let (rows, ..) = self.rows(py, start, stop.unwrap_or(self.scenes))?;
        let mut csv = csv_line(&self.header);
        csv.extend_from_slice(rows.as_bytes());
        Table::of_csv(csv).map_err(raised)
    }

    fn __len__(&self) -> usize {
        self.scenes as usize
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.text.text == other.text.text && self.text.scene == other.text.scene
    }

    fn __repr__(&self) -> String {
        format!("<Sweep of {} scenes, {} columns>", self.scenes, self.header.len())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, SweepText { file, text, scene }) = (slf.py(), slf.get().text.clone());
        let options = PyDict::new(py);
        options.set_item("_texts", (file, text, scene))?;
        called_with(slf.get_type().into_any(), &options)
    }
}

/// The table of a sweep in a file that grows in order, with a journal beside it, as `twofold sweep` writes it; either can continue what the other has begun.
#[pyclass(frozen, module = "twofold._twofold")]
pub struct SweepFile {
    out: PathBuf,
    replaced: bool,
    /// `None` if the table already has its name.
    spool: Option<Mutex<Spool>>,
    scenes: u64,
}

#[pymethods]
impl SweepFile {
    /// Begins a table at `out`, or continues an existing part of it. A file that exists is refused unless it may be replaced.
    #[new]
    #[pyo3(signature = (sweep, out, *, replace=false))]
    fn new(sweep: &Sweep, out: PathBuf, replace: bool) -> PyResult<Self> {
        // A link is followed: the table grows next to its target.
        let out = std::fs::canonicalize(&out).unwrap_or(out);
        let (files, scenes) = (SpoolFiles::of(&out), 0..sweep.scenes);
        let identity = Identity::new(&sweep.text, &scenes);
        let named_before = files.complete(&identity).is_some();
        if named_before && !files.rows.exists() && out.exists() {
            // Only the removal of files was interrupted.
            files.remove().map_err(raised)?;
            return Ok(Self { out, replaced: replace, spool: None, scenes: scenes.end });
        }
        // Whether errors come from an earlier attempt to name the table is checked when the table is named.
        for (path, replaced) in [(&out, replace), (&errors_beside(&out), replace || named_before)] {
            if (path.exists() || path.is_symlink()) && !replaced {
                return Err(raised(format!("{} exists; use replace=True to replace it", path.display())));
            }
        }
        let errors_header = csv_line(&Checked::new(&sweep.text).map_err(raised)?.errors_header());
        let spool =
            Spool::open(files, &identity, [&csv_line(&sweep.header), &errors_header], scenes).map_err(raised)?;
        Ok(Self { out, replaced: replace, spool: Some(Mutex::new(spool)), scenes: sweep.scenes })
    }

    /// The first scene that is not in the table.
    #[getter]
    fn next(&self) -> u64 {
        self.spool.as_ref().map_or(self.scenes, |spool| spool.lock().expect("nobody panics with it").next())
    }

    /// Appends the rows that `Sweep.rows` gives for the scenes from `next` to before `stop`, so that they outlive the process.
    fn append(&self, stop: u64, rows: &[u8], errors: &[u8], failed: u64) -> PyResult<()> {
        let spool = self.spool.as_ref().ok_or_else(|| raised("the table is complete".to_owned()))?;
        let mut spool = spool.lock().expect("nobody panics with it");
        spool.append(stop, [rows, errors], failed).and_then(|()| spool.commit()).map_err(raised)
    }

    /// Gives the complete table its name, and that of errors if there are any.
    fn complete(&self) -> PyResult<()> {
        let Some(spool) = &self.spool else { return Ok(()) };
        spool.lock().expect("nobody panics with it").give_names(&self.out, self.replaced).map_err(raised)
    }
}
