//! Scenes: a star, its initial motion, the coefficients for Lorentz violation, an observer and a beam.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString, PyTuple};
use twofold::inference::{Fisher, InferenceError, Signal, data_of, fit, nonlinearity};
use twofold::plan::Output;
use twofold_scene::columns::Column;
use twofold_scene::explained_plan::explained;
use twofold_scene::measurements::{DataFile, Measurement};
use twofold_scene::pulsar_timing::PulsarScene;
use twofold_scene::scene_file::{self, Columns};
use twofold_scene::trajectory::{LinesWanted, write_csv, write_lines, write_pulses};

use crate::arguments::{Names, Number, by_arguments, number};
use crate::error::raised;
use crate::fit::Fit;
use crate::motion::Motion;
use crate::pickle::Reduced;
use crate::pulsar::Pulsar;
use crate::table::Table;
use crate::writing::written;

/// A star, its initial motion, the coefficients for Lorentz violation, and what is observed: as in a scene file (docs/scenes.md).
///
/// `Scene("tp-1")` is a built-in scene and `Scene("my-star.toml")` that of a file; `Scene(toml=text)` that of a text. Sections are keyword
/// arguments: `Scene("tp-1", star={"spin": 1.2})` changes one number, `Scene("tp-1", pulsar=None)` removes a section, and a scene can be made of sections alone. Scenes are frozen, compare by their text and can be pickled.
#[pyclass(frozen, module = "twofold", name = "Scene")]
pub struct Scene {
    name: String,
    toml: String,
    pub(crate) scene: Arc<scene_file::Scene>,
    /// Why the columns of the file cannot be written, if the scene lacks something that they need.
    without_columns: Option<String>,
}

impl Scene {
    fn of_text(name: String, toml: String) -> PyResult<Self> {
        let read = |columns| scene_file::Scene::from_toml_with(&name, &toml, columns);
        let (scene, without_columns) = match read(Columns::OfTheFileLater) {
            Ok(scene) => (scene, None),
            Err(error) => (read(Columns::Unused).map_err(raised)?, Some(error.to_string())),
        };
        Ok(Self { name, toml, scene: Arc::new(scene), without_columns })
    }

    /// The measurement of the scene, and its signal.
    fn measured(
        &self,
        observe: &BTreeMap<String, Number>,
        parameters: Option<Names>,
    ) -> PyResult<(Measurement, Signal)> {
        Names(observe.keys().cloned().collect()).listed("observe")?;
        let observe: Vec<_> = observe.iter().map(|(name, Number(sigma))| format!("{name}:{sigma:e}")).collect();
        let parameters = parameters.map(|names| names.listed("parameters")).transpose()?;
        let measurement = Measurement::new((*self.scene).clone(), &observe.join(","), parameters.as_deref());
        let measurement = measurement.map_err(by_arguments)?;
        let signal = Signal::new(&measurement.parameters, measurement.end).map_err(raised)?;
        measurement.check_samples(&signal).map_err(raised)?;
        Ok((measurement, signal))
    }

    /// The scene for the given columns or those of the file, and with another method or tolerance.
    fn of_columns(
        &self,
        columns: Option<Names>,
        method: Option<&str>,
        tolerance: Option<Number>,
    ) -> PyResult<scene_file::Scene> {
        let mut scene = self.with(method, tolerance)?;
        match (columns, &self.without_columns) {
            (Some(Names(names)), _) => {
                scene.choose_columns(&names.iter().map(String::as_str).collect::<Vec<_>>()).map_err(raised)?;
            }
            (None, Some(why)) => return Err(raised(why)),
            (None, None) => (),
        }
        Ok(scene)
    }

    /// The scene with another method or tolerance.
    fn with(&self, method: Option<&str>, tolerance: Option<Number>) -> PyResult<scene_file::Scene> {
        let mut scene = (*self.scene).clone();
        if let Some(Number(tolerance)) = tolerance {
            twofold::Error::ensure((1e-14..=1e-2).contains(&tolerance), "tolerance", tolerance, "from 1e-14 to 1e-2")
                .map_err(raised)?;
            scene.tolerance = tolerance;
        }
        if let Some(method) = method {
            scene.choose_method(method).map_err(raised)?;
        }
        Ok(scene)
    }
}

/// The text of a scene with changed sections. A section or a key that is None is removed.
fn changed(py: Python<'_>, text: &str, sections: &Bound<'_, PyDict>) -> PyResult<String> {
    let document = py.import("tomllib")?.call_method1("loads", (text,)).map_err(raised)?.cast_into::<PyDict>()?;
    for (name, section) in sections {
        let Ok(keys) = section.cast::<PyDict>() else {
            if section.is_none() {
                if document.contains(&name)? {
                    document.del_item(&name)?;
                }
            } else {
                document.set_item(&name, section)?;
            }
            continue;
        };
        let whole = match document.get_item(&name)? {
            Some(found) => {
                found.cast_into::<PyDict>().map_err(|_| raised(format!("{name} is not a section of the scene")))?
            }
            None => PyDict::new(py),
        };
        for (key, value) in keys {
            if !value.is_none() {
                whole.set_item(key, plain(value)?)?;
            } else if whole.contains(&key)? {
                whole.del_item(key)?;
            }
        }
        document.set_item(name, whole)?;
    }
    py.import("tomli_w")?.call_method1("dumps", (document,)).map_err(raised)?.extract()
}

/// Arrays and numbers of numpy converted to Python's, also within lists.
fn plain(value: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    if value.hasattr("tolist")? {
        return value.call_method0("tolist");
    }
    match value.cast::<PyList>() {
        Ok(list) => {
            let items = list.iter().map(plain).collect::<PyResult<Vec<_>>>()?;
            Ok(PyList::new(value.py(), items)?.into_any())
        }
        Err(_) => Ok(value),
    }
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (source=None, /, *, toml=None, **sections: "object"))]
    fn new(
        py: Python<'_>,
        source: Option<&Bound<'_, PyAny>>,
        toml: Option<String>,
        sections: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let (name, text) = match (source, toml) {
            (Some(_), Some(_)) => return Err(raised("a scene has one source; give either a name or path, or toml=")),
            (None, None) if sections.is_none() => {
                return Err(raised("no scene; give a name, a path, toml= or sections such as star={...}"));
            }
            (None, text) => ("scene".to_owned(), text.unwrap_or_default()),
            (Some(source), None) => {
                let name: String = py.import("os")?.call_method1("fsdecode", (source,))?.extract()?;
                let text = scene_file::text_of(&name).map_err(raised)?;
                (name, text)
            }
        };
        let text = match sections {
            Some(sections) => changed(py, &text, sections)?,
            None => text,
        };
        Self::of_text(name, text)
    }

    /// The names of the built-in scenes.
    #[staticmethod]
    fn names() -> Vec<&'static str> {
        scene_file::names()
    }

    /// Where the scene comes from: a built-in name or a path.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// The text of the scene file.
    #[getter]
    fn toml(&self) -> &str {
        &self.toml
    }

    /// A description of the scene, in one line.
    #[getter]
    fn about(&self) -> &str {
        &self.scene.about
    }

    /// Warnings about input that is allowed but looks like a mistake.
    #[getter]
    fn cautions(&self) -> Vec<&str> {
        self.scene.cautions.iter().map(String::as_str).collect()
    }

    /// Modified Julian date (TDB) of the start, as a text; None for a scene without one.
    #[getter]
    fn epoch(&self) -> Option<String> {
        self.scene.epoch.as_ref().map(ToString::to_string)
    }

    /// The beam: the angle `chi` of the magnetic axis to the symmetry axis, its azimuth `delta` and the semi-open angle `rho` (rad); None for a scene without one.
    #[getter]
    fn beam(&self) -> Option<(f64, f64, f64)> {
        self.scene.pulsar.map(|pulsar| (pulsar.chi, pulsar.delta, pulsar.rho))
    }

    /// The unit of time: `t_c` in the paper's units, `s` for a physical star.
    #[getter]
    fn time_unit(&self) -> &str {
        self.scene.units.time_name
    }

    /// First and last time, in `time_unit`.
    #[getter]
    fn span(&self) -> (f64, f64) {
        (self.scene.times.start(), self.scene.times.last())
    }

    /// The table that `twofold run` writes, for groups of columns (`["angles", "e_z", "h"]`) or those of the scene.
    #[pyo3(signature = (columns=None, *, method=None, tolerance=None, progress=None))]
    fn table(
        &self,
        py: Python<'_>,
        columns: Option<Names>,
        method: Option<&str>,
        tolerance: Option<Number>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Table> {
        let scene = self.of_columns(columns, method, tolerance)?;
        scene.check_rotation(&scene.columns).map_err(raised)?;
        written(py, progress, |writer, tell| write_csv(&scene, writer, tell))
    }

    /// The pulses in the span of the scene, as `twofold pulses` writes them.
    #[pyo3(signature = (*, method=None, tolerance=None, progress=None))]
    fn pulses(
        &self,
        py: Python<'_>,
        method: Option<&str>,
        tolerance: Option<Number>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Table> {
        let scene = self.with(method, tolerance)?;
        scene.check_rotation(&[Output::Pulses]).map_err(raised)?;
        written(py, progress, |writer, tell| write_pulses(&scene, writer, tell))
    }

    /// The spectral lines of a column (`"m.n"`, `"h_plus"`), strongest first, down to the fraction `least` of the largest amplitude. Frequencies are in rad per
    /// `time_unit`, phases those at the start.
    #[pyo3(signature = (column, *, least: "SupportsFloat | SupportsIndex"=1e-6, most=50))]
    fn lines(
        &self,
        py: Python<'_>,
        column: &str,
        #[pyo3(from_py_with = number)] least: f64,
        most: usize,
    ) -> PyResult<Table> {
        twofold::Error::ensure(most > 0, "most", most as f64, "at least 1").map_err(raised)?;
        twofold::Error::ensure((1e-12..=1.0).contains(&least), "least", least, "from 1e-12 to 1").map_err(raised)?;
        let column = Column::oscillating(column, &self.scene).map_err(raised)?;
        let wanted = LinesWanted { least, most, in_turns: false };
        written(py, None, |writer, _| write_lines(&self.scene, &column, &wanted, writer))
    }

    /// The plan for groups of columns, or for those of the scene, in words: the method, its cost and error, and what is left out.
    #[pyo3(signature = (columns=None, *, method=None, tolerance=None))]
    fn plan(&self, columns: Option<Names>, method: Option<&str>, tolerance: Option<Number>) -> PyResult<String> {
        let scene = self.of_columns(columns, method, tolerance)?;
        Ok(explained(&scene, &scene.plan(&scene.columns).map_err(raised)?))
    }

    /// The motion from the start of the scene to the time `end`, its last one if none is given.
    #[pyo3(signature = (end=None, *, method=None, tolerance=None))]
    fn motion(
        slf: Bound<'_, Self>,
        py: Python<'_>,
        end: Option<Number>,
        method: Option<String>,
        tolerance: Option<Number>,
    ) -> PyResult<Motion> {
        let scene = slf.get().with(method.as_deref(), tolerance)?;
        let end = end.map_or(scene.times.last(), |Number(end)| end);
        Motion::new(py, slf.unbind(), scene, end, method)
    }

    /// How well measurements of the scene would determine its parameters. `observe` has the standard deviation of each kind of data in the units of the scene, as
    /// `{"arrivals": 1e-4, "widths": 1e-4}`; kinds are arrivals, closest_approaches, widths, periods, h_plus, h_cross and strain. `parameters` are names (docs/inference.md); if none are given, those that such data can determine.
    #[pyo3(signature = (observe, parameters=None))]
    fn fisher(&self, py: Python<'_>, observe: BTreeMap<String, Number>, parameters: Option<Names>) -> PyResult<Fit> {
        let (measurement, signal) = self.measured(&observe, parameters)?;
        let fisher = py.detach(|| {
            let events = measurement.events(&signal)?;
            let data = data_of(&signal, &events, &measurement.samples(), &measurement.noise)?;
            Fisher::of(&measurement.parameters, &events, &data, &measurement.unknowns)
        });
        Ok(Fit::of_fisher(&fisher.map_err(raised)?, |unknown| measurement.unit(unknown)))
    }

    /// Fits parameters of the scene to data: tables of `pulses()` and of `table(["h"])`, or paths of such files. `observe` and `parameters` are as for `fisher`; the fit starts from the values of the scene.
    #[pyo3(signature = (data, observe, parameters=None))]
    fn fit(
        &self,
        py: Python<'_>,
        data: Vec<Bound<'_, PyAny>>,
        observe: BTreeMap<String, Number>,
        parameters: Option<Names>,
    ) -> PyResult<Fit> {
        let (measurement, signal) = self.measured(&observe, parameters)?;
        let read = |(k, one): (usize, &Bound<'_, PyAny>)| match one.cast::<Table>() {
            Ok(table) => DataFile::of_bytes(&format!("data[{k}]"), table.get().csv.clone()).map_err(raised),
            Err(_) => DataFile::read(&one.extract::<PathBuf>()?.to_string_lossy()).map_err(raised),
        };
        let tables = data.iter().enumerate().map(read).collect::<PyResult<Vec<_>>>()?;
        let (data, _) = measurement.data_in(&tables, &signal).map_err(by_arguments)?;
        let found = py.detach(|| {
            let found = fit(&measurement.parameters, &data, &measurement.unknowns, measurement.end)?;
            let nonlinearity = nonlinearity(&found.fisher, &data, measurement.end).unwrap_or(f64::INFINITY);
            Ok::<_, InferenceError>((found, nonlinearity))
        });
        let (found, nonlinearity) = found.map_err(raised)?;
        Ok(Fit::of_fit(found, |unknown| measurement.unit(unknown), nonlinearity))
    }

    /// The pulsar over decades: arrival times, its timing model, its wave. The scene needs `time.epoch`, `[observer]` and `[pulsar]`.
    fn pulsar(slf: Bound<'_, Self>) -> PyResult<Pulsar> {
        let pulsar = PulsarScene::new(&slf.get().scene).map_err(raised)?;
        Ok(Pulsar { scene: slf.unbind(), pulsar })
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.toml == other.toml
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        PyString::new(slf.py(), &slf.get().toml).hash()
    }

    fn __repr__(&self) -> String {
        format!("<Scene {}: {}>", self.name, self.scene.about)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let Self { name, toml, .. } = slf.get();
        let made_again = slf.get_type().getattr("_of_text")?;
        Ok((made_again, PyTuple::new(slf.py(), [name, toml])?))
    }

    /// A scene from the name and text of another, for pickle.
    #[staticmethod]
    fn _of_text(name: String, toml: String) -> PyResult<Self> {
        Self::of_text(name, toml)
    }
}
