//! Fits of timing models, Fisher matrices, limits.

use std::f64::consts::TAU;
use std::path::PathBuf;

use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyKeyError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use twofold::inference::{self, Fisher, MeasuredArrival, MeasuredWidth, Model, Observable, Prior, Residuals, Unknown};
use twofold::nalgebra::{DMatrix, DVector};
use twofold::observables::pulsar::timing_model::TimingParameter;
use twofold_scene::measurements::{measured_twice, named, parse_noise, read_timing};

use crate::arguments::{Names, Number, by_arguments, number};
use crate::arrays::{Array, Numbers, array};
use crate::error::raised;
use crate::pickle::{Reduced, called_with};
use crate::pulsar::epoch;
use crate::timing_model::{TimingModel, WHOLE, is_whole, timing_parameter};

/// Arrival times and pulse widths with independent errors. Times and standard deviations are in seconds, times since the epoch of the model.
///
/// `TimingData(times, sigmas)` are arrivals; `rest` is the small part of times that need two doubles, `numbers` has the numbers of the pulses, NaN where one is not known.
/// `TimingData(width_times=..., widths=..., width_sigmas=...)` are widths.
#[pyclass(frozen, module = "twofold")]
pub struct TimingData {
    data: inference::TimingData,
}

#[pymethods]
impl TimingData {
    #[new]
    #[pyo3(signature = (times=None, sigmas=None, *, rest=None, numbers=None, width_times=None, widths=None, width_sigmas=None))]
    fn new(
        times: Option<Numbers>,
        sigmas: Option<Numbers>,
        rest: Option<Numbers>,
        numbers: Option<Numbers>,
        width_times: Option<Numbers>,
        widths: Option<Numbers>,
        width_sigmas: Option<Numbers>,
    ) -> PyResult<Self> {
        let times = read("times", times)?;
        let count = times.len();
        let of = |name: &str, given: Option<Numbers>| given.map(|given| given.list_of(name, count)).transpose();
        let sigmas = of("sigmas", sigmas)?.unwrap_or_default();
        if sigmas.len() != count {
            return Err(raised("times without sigmas; each arrival time needs a standard deviation"));
        }
        let rest = of("rest", rest)?.unwrap_or(vec![0.0; count]);
        let numbers = of("numbers", numbers)?;
        for number in numbers.iter().flatten().filter(|number| !number.is_nan()) {
            twofold::Error::ensure(is_whole(*number), "numbers", *number, WHOLE).map_err(raised)?;
        }
        let arrival = |k: usize| MeasuredArrival {
            time: [times[k], rest[k]],
            sigma: sigmas[k],
            number: numbers.as_ref().filter(|numbers| !numbers[k].is_nan()).map(|numbers| numbers[k] as i64),
        };
        let (at, wide) = (read("width_times", width_times)?, read("widths", widths)?);
        let errors = read("width_sigmas", width_sigmas)?;
        if wide.len() != at.len() || errors.len() != at.len() {
            return Err(raised(format!(
                "width_times, widths and width_sigmas have the lengths {}, {} and {}: must be equal",
                at.len(),
                wide.len(),
                errors.len()
            )));
        }
        for (name, values) in [("times (s)", &times), ("rest (s)", &rest), ("width_times (s)", &at)] {
            each(values, name, |value| value.is_finite(), "a finite number")?;
        }
        for (name, values) in [("sigmas (s)", &sigmas), ("widths (s)", &wide), ("width_sigmas (s)", &errors)] {
            each(values, name, |value| value > 0.0 && value.is_finite(), "a finite number above zero")?;
        }
        let width = |k: usize| MeasuredWidth { time: at[k], duration: wide[k], sigma: errors[k] };
        let (arrivals, widths) = ((0..count).map(arrival).collect(), (0..at.len()).map(width).collect());
        let data = inference::TimingData { arrivals, widths, priors: Vec::new() };
        if let Some([time, _]) = measured_twice(&data) {
            return Err(raised(format!("the datum at t = {time:?} s occurs twice; each datum can be given only once")));
        }
        Ok(Self { data })
    }

    /// The data of files: a `.tim` (FORMAT 1, barycentred), or tables as `Pulsar.arrivals` gives them, with the standard deviations in `observe`, as `"arrivals:1e-6,widths:1e-5"` (s). Times
    /// are counted from the epoch of a model (MJD, TDB). Each file numbers its pulses from its own first: where more than one has numbers, `model` is the
    /// timing model by which they are matched.
    #[staticmethod]
    #[pyo3(signature = (paths, epoch, *, model=None, observe=None))]
    fn read(
        paths: Vec<PathBuf>,
        epoch: &Bound<'_, PyAny>,
        model: Option<&TimingModel>,
        observe: Option<&str>,
    ) -> PyResult<Self> {
        let epoch = read_epoch(epoch)?;
        let allowed = [Observable::Arrivals, Observable::Widths];
        let noise = observe.map_or_else(|| Ok(Vec::new()), |text| parse_noise(text, &allowed, 1.0));
        let noise = noise.map_err(|why| raised(format!("observe: {why}")))?;
        let paths: Vec<_> = paths.iter().map(|path| path.to_string_lossy().into_owned()).collect();
        Ok(Self { data: read_timing(&paths, &epoch, &noise, model.map(|model| &model.model)).map_err(by_arguments)? })
    }

    /// Times of the arrivals (s): an array of shape (n, 2), two parts each.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let values: Vec<f64> = self.data.arrivals.iter().flat_map(|arrival| arrival.time).collect();
        Ok(Array(PyArray1::from_vec(py, values).reshape([self.data.arrivals.len(), 2])?.into_any()))
    }

    /// Standard deviations of the arrivals (s).
    #[getter]
    fn sigmas<'py>(&self, py: Python<'py>) -> Array<'py> {
        array(py, self.data.arrivals.iter().map(|arrival| arrival.sigma))
    }

    /// Numbers of the pulses, NaN where they are not known.
    #[getter]
    fn numbers<'py>(&self, py: Python<'py>) -> Array<'py> {
        array(py, self.data.arrivals.iter().map(|arrival| arrival.number.map_or(f64::NAN, |number| number as f64)))
    }

    /// Widths: an array of shape (n, 3) of their times, the widths and their standard deviations (s).
    #[getter]
    fn widths<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let values = self.data.widths.iter().flat_map(|width| [width.time, width.duration, width.sigma]).collect();
        Ok(Array(PyArray1::from_vec(py, values).reshape([self.data.widths.len(), 3])?.into_any()))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.data == other.data
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, data) = (slf.py(), &slf.get().data);
        let options = PyDict::new(py);
        options.set_item("times", array(py, data.arrivals.iter().map(|arrival| arrival.time[0])))?;
        options.set_item("rest", array(py, data.arrivals.iter().map(|arrival| arrival.time[1])))?;
        options.set_item("sigmas", array(py, data.arrivals.iter().map(|arrival| arrival.sigma)))?;
        options.set_item("numbers", slf.get().numbers(py))?;
        options.set_item("width_times", array(py, data.widths.iter().map(|width| width.time)))?;
        options.set_item("widths", array(py, data.widths.iter().map(|width| width.duration)))?;
        options.set_item("width_sigmas", array(py, data.widths.iter().map(|width| width.sigma)))?;
        called_with(slf.get_type().into_any(), &options)
    }

    fn __repr__(&self) -> String {
        format!("<TimingData: {} arrivals, {} widths>", self.data.arrivals.len(), self.data.widths.len())
    }
}

/// An epoch as a number, or as a text with more digits.
fn read_epoch(given: &Bound<'_, PyAny>) -> PyResult<twofold::epoch::Epoch> {
    match given.extract::<String>() {
        Ok(text) => text.parse().map_err(raised),
        Err(_) => epoch(number(given).map_err(|_| PyTypeError::new_err("epoch: must be a modified Julian date"))?),
    }
}

/// Refuses values of an argument that are not allowed.
fn each(values: &[f64], name: &'static str, is_allowed: fn(f64) -> bool, allowed: &'static str) -> PyResult<()> {
    values
        .iter()
        .try_for_each(|value| twofold::Error::ensure(is_allowed(*value), name, *value, allowed).map_err(raised))
}

/// Unknowns of a timing model from their names.
fn unknowns_of(names: &Names) -> PyResult<Vec<TimingParameter>> {
    named(&names.listed("unknowns")?, &TimingParameter::ALL).map_err(|why| raised(format!("unknowns: {why}")))
}

/// An optional list.
fn read(name: &str, given: Option<Numbers>) -> PyResult<Vec<f64>> {
    given.map_or_else(|| Ok(Vec::new()), |given| given.list(name))
}

/// Estimates of unknown parameters: values, standard deviations, correlations. The result of `Scene.fisher` and, with residuals, of fits.
#[pyclass(frozen, module = "twofold", name = "Fit")]
pub struct Fit {
    /// The names of the unknowns.
    #[pyo3(get)]
    unknowns: Vec<String>,
    units: Vec<String>,
    values: Vec<f64>,
    sigmas: Vec<f64>,
    covariance: Vec<f64>,
    /// The combinations that the data do not determine, in words.
    #[pyo3(get)]
    undetermined: Vec<String>,
    /// The fitted model: a `TimingModel`. None for a fit of a scene's motion, which has only its values.
    #[pyo3(get)]
    model: Option<TimingModel>,
    /// The sum of the squares of the residuals in standard deviations. None for a Fisher matrix.
    #[pyo3(get)]
    chi_squared: Option<f64>,
    /// Degrees of freedom: the number of data less that of unknowns.
    #[pyo3(get)]
    degrees: Option<usize>,
    residuals: Option<Vec<f64>>,
    /// Whether the residuals are `"as stated"` by their errors, `"larger"` or `"smaller"`, at six standard deviations of chi^2.
    #[pyo3(get)]
    judged: Option<&'static str>,
    /// Deviation of chi^2 from its parabola at one standard deviation: error bars are rough from 0.3 on.
    #[pyo3(get)]
    nonlinearity: Option<f64>,
}

impl Fit {
    /// `unit` gives the factor to the unit of an unknown, and this unit.
    pub fn of_fisher<M: Model>(fisher: &Fisher<M>, unit: impl Fn(M::Unknown) -> (f64, String)) -> Self {
        let (factors, units): (Vec<f64>, Vec<_>) = fisher.unknowns.iter().map(|unknown| unit(*unknown)).unzip();
        let scaled = |values: Vec<f64>| values.iter().zip(&factors).map(|(value, factor)| value * factor).collect();
        let count = factors.len();
        let entry = |k: usize| fisher.covariance[(k / count, k % count)] * factors[k / count] * factors[k % count];
        let weak = fisher.degenerate.iter().chain(&fisher.weak);
        Self {
            unknowns: fisher.unknowns.iter().map(|unknown| unknown.key().to_owned()).collect(),
            units,
            values: scaled(fisher.values()),
            sigmas: scaled(fisher.sigmas()),
            covariance: (0..count * count).map(entry).collect(),
            undetermined: weak.map(ToString::to_string).collect(),
            model: None,
            chi_squared: None,
            degrees: None,
            residuals: None,
            judged: None,
            nonlinearity: None,
        }
    }

    pub fn of_fit<M: Model>(
        found: inference::Fit<M>,
        unit: impl Fn(M::Unknown) -> (f64, String),
        nonlinearity: f64,
    ) -> Self {
        let judged = match found.consistency() {
            Residuals::Consistent => "as stated",
            Residuals::Larger => "larger",
            Residuals::Smaller => "smaller",
        };
        Self {
            chi_squared: Some(found.chi_squared),
            degrees: Some(found.degrees),
            judged: Some(judged),
            nonlinearity: Some(nonlinearity),
            ..Self { residuals: Some(found.residuals), ..Self::of_fisher(&found.fisher, unit) }
        }
    }
}

#[pymethods]
impl Fit {
    /// The unit of each unknown, for its value and its standard deviation; `1` for a number without a unit.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let units = PyDict::new(py);
        self.unknowns.iter().zip(&self.units).try_for_each(|(unknown, unit)| units.set_item(unknown, unit))?;
        Ok(units)
    }

    /// The values of the unknowns.
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Array<'py> {
        array(py, self.values.iter().copied())
    }

    /// The standard deviations of the unknowns.
    #[getter]
    fn sigmas<'py>(&self, py: Python<'py>) -> Array<'py> {
        array(py, self.sigmas.iter().copied())
    }

    /// The covariance of the unknowns.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let count = self.values.len();
        Ok(Array(PyArray1::from_slice(py, &self.covariance).reshape([count, count])?.into_any()))
    }

    /// Residuals, measured less fitted, in standard deviations.
    #[getter]
    fn residuals<'py>(&self, py: Python<'py>) -> Option<Array<'py>> {
        self.residuals.as_ref().map(|residuals| array(py, residuals.iter().copied()))
    }

    /// The value of an unknown and its standard deviation.
    fn __getitem__(&self, name: &str) -> PyResult<(f64, f64)> {
        let found = self.unknowns.iter().position(|unknown| unknown == name);
        let unknowns = || self.unknowns.join(", ");
        let place =
            found.ok_or_else(|| PyKeyError::new_err(format!("`{name}` is not fitted; fitted are {}", unknowns())))?;
        Ok((self.values[place], self.sigmas[place]))
    }

    fn __repr__(&self) -> String {
        let rows = self.unknowns.iter().zip(&self.values).zip(&self.sigmas);
        let rows: Vec<_> = rows.map(|((name, value), sigma)| format!("{name} = {value:e} +- {sigma:.1e}")).collect();
        let residuals = self.chi_squared.zip(self.degrees);
        let residuals = residuals.map_or(String::new(), |(chi, degrees)| format!("; chi^2 = {chi:.1} of {degrees}"));
        format!("<Fit: {}{residuals}>", rows.join(", "))
    }
}

/// Fits a timing model to data. `unknowns` are names from `TimingModel.names`; `priors` gives a mean and a standard deviation of some, as `{"chi": (1.2, 0.05)}`.
#[pyfunction]
#[pyo3(signature = (model, data, unknowns, *, priors=None))]
pub fn fit_timing(
    py: Python<'_>,
    model: &TimingModel,
    data: &TimingData,
    unknowns: Names,
    priors: Option<&Bound<'_, PyDict>>,
) -> PyResult<Fit> {
    let unknowns = unknowns_of(&unknowns)?;
    let mut data = data.data.clone();
    for (name, prior) in priors.iter().flat_map(|priors| priors.iter()) {
        let name: String = name.extract()?;
        let parameter = timing_parameter(&name)?;
        let [Number(mean), Number(sigma)] = prior.extract().map_err(|_| {
            raised(format!("priors[{name:?}]: must be a pair of numbers, the mean and the standard deviation"))
        })?;
        twofold::Error::ensure(mean.is_finite(), "mean of a prior", mean, "a finite number").map_err(raised)?;
        if !unknowns.contains(&parameter) {
            return Err(raised(format!("priors[{name:?}]: must be one of the unknowns")));
        }
        data.priors.push(Prior { parameter, mean, sigma });
    }
    let (found, nonlinearity) = py
        .detach(|| {
            let found = inference::fit_timing(&model.model, &data, &unknowns)?;
            let nonlinearity = inference::timing_nonlinearity(&found.fisher, &data).unwrap_or(f64::INFINITY);
            Ok::<_, inference::InferenceError>((found, nonlinearity))
        })
        .map_err(raised)?;
    let model = TimingModel { model: found.fisher.parameters.clone() };
    Ok(Fit { model: Some(model), ..Fit::of_fit(found, |unknown| (1.0, unknown.unit().to_owned()), nonlinearity) })
}

/// Upper limits on the wobble at some precession periods (s), for a model that was fitted to the arrival times without a wobble by the `unknowns`. A dict of arrays: `period` (s), the `best` wobble (rad), the `gain` (the decrease of chi^2 by it), and the `limit` (rad) that is not exceeded with the probability `confidence`; infinite where the data do not limit it. chi and the torque share are those of the model.
#[pyfunction]
#[pyo3(signature = (model, data, unknowns, periods, *, confidence: "SupportsFloat | SupportsIndex"=0.95))]
pub fn wobble_limits<'py>(
    py: Python<'py>,
    model: &TimingModel,
    data: &TimingData,
    unknowns: Names,
    periods: Numbers,
    #[pyo3(from_py_with = number)] confidence: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let unknowns = unknowns_of(&unknowns)?;
    let periods = periods.list("periods")?;
    each(&periods, "period (s)", |period| period > 0.0 && period.is_finite(), "a finite number above zero")?;
    let rates: Vec<f64> = periods.iter().map(|period| TAU / period).collect();
    let limits = py
        .detach(|| inference::wobble_limits(&model.model, &data.data, &unknowns, &rates, confidence))
        .map_err(raised)?;
    let table = PyDict::new(py);
    table.set_item("period", array(py, periods))?;
    for (name, of) in [("best", 0), ("gain", 1), ("limit", 2)] {
        let values = limits.iter().map(|limit| [limit.best, limit.gain, limit.limit][of]);
        table.set_item(name, array(py, values))?;
    }
    Ok(table)
}

/// The posterior of a small wobble `x = theta (cos psi_0, sin psi_0)` (rad) in which the residuals are linear: `residuals + along x[0] + across x[1]`, in standard deviations and with the other unknowns projected out. A dict: the `best` x, the `gain` (the decrease of chi^2 by it), and the `limit` on theta that is not exceeded with the probability `confidence`, with a flat prior for theta and psi_0; infinite where it or the wider standard deviation of the wobble is above 0.1 rad.
#[pyfunction]
#[pyo3(signature = (along, across, residuals, *, confidence: "SupportsFloat | SupportsIndex"=0.95))]
pub fn wobble_posterior<'py>(
    py: Python<'py>,
    along: Numbers,
    across: Numbers,
    residuals: Numbers,
    #[pyo3(from_py_with = number)] confidence: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let residuals = residuals.list("residuals")?;
    let columns = [along.list("along")?, across.list("across")?];
    for (name, column) in ["along", "across"].into_iter().zip(&columns) {
        if column.len() != residuals.len() {
            let (found, allowed) = (column.len(), residuals.len());
            return Err(raised(format!("{name} has the length {found}: must have the length of residuals, {allowed}")));
        }
    }
    let columns = DMatrix::from_vec(residuals.len(), 2, columns.concat());
    let posterior = inference::WobblePosterior::new(columns, &DVector::from_vec(residuals)).map_err(raised)?;
    let table = PyDict::new(py);
    table.set_item("best", array(py, posterior.best().to_vec()))?;
    table.set_item("gain", posterior.gain())?;
    table.set_item("limit", posterior.limit(confidence).map_err(raised)?)?;
    Ok(table)
}
