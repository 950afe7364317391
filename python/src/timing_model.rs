//! The phase of a wobbling pulsar that slows down, for timing programs.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMappingProxy, PyTuple};
use twofold::observables::pulsar::timing_model::{self, TimingParameter};

use crate::arguments::{Number, number};
use crate::arrays::Numbers;
use twofold_scene::measurements::named;

use crate::error::raised;
use crate::pickle::{Reduced, called_with};

/// A pulsar by its timing parameters (docs/timing-model.md). `TimingModel(f0, f1=..., wobble=..., chi=...)`: F0 in Hz, the others in SI units and rad. Those not given are zero, but chi and inclination are
/// a right angle. F0 is the sum of two doubles, `f0 + f0_rest`.
///
/// Times are in seconds since the epoch, the sum of two doubles `t + rest`; arrays of any shape are taken.
#[pyclass(frozen, module = "twofold", from_py_object)]
#[derive(Clone)]
pub struct TimingModel {
    pub(crate) model: timing_model::TimingModel,
}

/// Allowed numbers of pulses.
pub const WHOLE: &str = "a whole number, up to 2^53 in size";

/// Whether it is allowed as a pulse number.
pub fn is_whole(number: f64) -> bool {
    number.fract() == 0.0 && number.abs() <= (1_u64 << 53) as f64
}

/// The small parts of times. The times must be finite.
fn small_parts(t: &Numbers, rest: Option<Numbers>) -> PyResult<Vec<f64>> {
    let rest = rest.map_or_else(|| Ok(vec![0.0; t.values.len()]), |rest| t.beside("rest", rest))?;
    for (name, value) in t.values.iter().map(|t| ("t (s)", *t)).chain(rest.iter().map(|rest| ("rest (s)", *rest))) {
        twofold::Error::ensure(value.is_finite(), name, value, "a finite number").map_err(raised)?;
    }
    Ok(rest)
}

#[pymethods]
impl TimingModel {
    #[new]
    #[pyo3(signature = (f0, f0_rest: "SupportsFloat | SupportsIndex"=0.0, **parameters: "float"))]
    fn new(
        f0: Number,
        #[pyo3(from_py_with = number)] f0_rest: f64,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let given = parameters.map_or_else(|| Ok(Vec::new()), values)?;
        Ok(Self { model: timing_model::TimingModel::new([f0.0, f0_rest], &given).map_err(raised)? })
    }

    /// The names of the parameters, in the order of derivatives.
    #[classattr]
    fn names(py: Python<'_>) -> PyResult<Bound<'_, PyTuple>> {
        PyTuple::new(py, TimingParameter::ALL.map(TimingParameter::key))
    }

    /// The unit of each parameter. It cannot be changed.
    #[classattr]
    fn units(py: Python<'_>) -> PyResult<Bound<'_, PyMappingProxy>> {
        let units = PyDict::new(py);
        TimingParameter::ALL.iter().try_for_each(|parameter| units.set_item(parameter.key(), parameter.unit()))?;
        Ok(PyMappingProxy::new(py, units.as_mapping()))
    }

    /// The value of a parameter.
    fn __getitem__(&self, name: &str) -> PyResult<f64> {
        Ok(self.model.value(timing_parameter(name)?))
    }

    /// F0 (Hz), the sum of two doubles.
    #[getter]
    fn frequency(&self) -> [f64; 2] {
        self.model.frequency()
    }

    /// The model with increments added to some parameters. F0 keeps 32 digits, so that small changes add up.
    #[pyo3(signature = (**changes: "float"))]
    fn moved(&self, changes: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let changes = changes.map_or_else(|| Ok(Vec::new()), values)?;
        Ok(Self { model: self.model.moved(&changes).map_err(raised)? })
    }

    /// The phase at times: whole turns and the fraction of a turn, two arrays. A pulse is where the fraction is zero.
    #[pyo3(signature = (t, rest=None))]
    fn phase<'py>(
        &self,
        py: Python<'py>,
        t: Numbers,
        rest: Option<Numbers>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let rest = small_parts(&t, rest)?;
        let found = t.map(py, |k, t| self.model.phase([t, rest[k]]))?;
        let whole = t.shaped(py, found.iter().map(|turns| turns.whole as f64).collect(), &[])?;
        Ok((whole, t.shaped(py, found.iter().map(|turns| turns.fraction).collect(), &[])?))
    }

    /// The rate of the phase at times (Hz): if the phase is off by `x` turns, the pulse is late by `x` over this rate.
    #[pyo3(signature = (t, rest=None))]
    fn phase_rate<'py>(&self, py: Python<'py>, t: Numbers, rest: Option<Numbers>) -> PyResult<Bound<'py, PyAny>> {
        let rest = small_parts(&t, rest)?;
        let found = t.map(py, |k, t| self.model.phase_rate([t, rest[k]]))?;
        t.shaped(py, found, &[])
    }

    /// The phase as from `phase`, and its derivatives (turns per unit of each parameter): an array of shape (..., 13).
    #[pyo3(signature = (t, rest=None))]
    fn phase_and_derivatives<'py>(
        &self,
        py: Python<'py>,
        t: Numbers,
        rest: Option<Numbers>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let rest = small_parts(&t, rest)?;
        let found = t.map(py, |k, t| self.model.phase_and_derivatives([t, rest[k]]))?;
        let whole = t.shaped(py, found.iter().map(|(turns, _)| turns.whole as f64).collect(), &[])?;
        let fraction = t.shaped(py, found.iter().map(|(turns, _)| turns.fraction).collect(), &[])?;
        let derivatives = found.iter().flat_map(|(_, derivatives)| *derivatives).collect();
        Ok((whole, fraction, t.shaped(py, derivatives, &[TimingParameter::ALL.len()])?))
    }

    /// The arrival times of the pulses with given numbers: two arrays whose sum is the time.
    fn arrival<'py>(&self, py: Python<'py>, number: Numbers) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        for value in &number.values {
            twofold::Error::ensure(is_whole(*value), "number", *value, WHOLE).map_err(raised)?;
        }
        let found = number.map(py, |_, number| self.model.arrival(number as i64))?;
        let [t, rest] = [0, 1].map(|part| number.shaped(py, found.iter().map(|time| time[part]).collect(), &[]));
        Ok((t?, rest?))
    }

    /// The widths of pulses (s) near times.
    fn width<'py>(&self, py: Python<'py>, t: Numbers) -> PyResult<Bound<'py, PyAny>> {
        small_parts(&t, None)?;
        let found = t.map(py, |_, t| self.model.width(t))?;
        t.shaped(py, found, &[])
    }

    fn __eq__(&self, other: &Self) -> bool {
        let same = |parameter| self.model.value(parameter) == other.model.value(parameter);
        self.frequency() == other.frequency() && TimingParameter::ALL.into_iter().all(same)
    }

    fn __repr__(&self) -> PyResult<String> {
        let others = TimingParameter::ALL.into_iter().filter(|parameter| *parameter != TimingParameter::F0);
        let bare = timing_model::TimingModel::new(self.frequency(), &[]).map_err(raised)?;
        let others = others.filter(|parameter| self.model.value(*parameter) != bare.value(*parameter));
        let others: String = others.map(|one| format!(", {}={:?}", one.key(), self.model.value(one))).collect();
        let [f0, rest] = self.frequency();
        Ok(format!("TimingModel({f0:?}, {rest:?}{others})"))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, of) = (slf.py(), slf.get());
        let options = PyDict::new(py);
        for parameter in TimingParameter::ALL.into_iter().filter(|parameter| *parameter != TimingParameter::F0) {
            options.set_item(parameter.key(), of.model.value(parameter))?;
        }
        let [f0, rest] = of.frequency();
        options.set_item("f0", f0)?;
        options.set_item("f0_rest", rest)?;
        called_with(slf.get_type().into_any(), &options)
    }
}

/// Parameter values from a dict by name.
fn values(given: &Bound<'_, PyDict>) -> PyResult<Vec<(TimingParameter, f64)>> {
    let read = |(name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let name: String = name.extract()?;
        let parameter = timing_parameter(&name)?;
        let number = number(&value).map_err(|error| {
            if error.is_instance_of::<PyTypeError>(value.py()) {
                PyTypeError::new_err(format!("{name}: {}", error.value(value.py())))
            } else {
                error
            }
        })?;
        Ok((parameter, number))
    };
    given.iter().map(read).collect()
}

/// The parameter called `name`.
pub fn timing_parameter(name: &str) -> PyResult<TimingParameter> {
    match named(name, &TimingParameter::ALL).map_err(raised)?[..] {
        [parameter] => Ok(parameter),
        _ => Err(raised(format!("`{name}`: must be the name of one parameter"))),
    }
}
