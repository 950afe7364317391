//! Numbers from Python and back: a scalar or an array of any shape.

use numpy::{PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt};

use crate::error::raised;

/// Numbers computed between two looks for Ctrl-C.
const AT_ONCE: usize = 1 << 14;

/// A scalar or an array, as Python gives it.
pub struct Numbers {
    pub values: Vec<f64>,
    /// None of a scalar.
    shape: Option<Vec<usize>>,
}

impl Numbers {
    /// The numbers of an argument called `name`.
    pub fn of(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(number) = given.cast::<PyFloat>() {
            return Ok(Self { values: vec![number.value()], shape: None });
        }
        if given.cast_exact::<PyInt>().is_ok() {
            return Ok(Self { values: vec![given.extract()?], shape: None });
        }
        let py = given.py();
        let refused = || PyTypeError::new_err(format!("{name}: allowed is a real number or an array of real numbers"));
        let numpy = py.import(pyo3::intern!(py, "numpy"))?;
        let array = numpy.call_method1(pyo3::intern!(py, "asarray"), (given,)).map_err(|_| refused())?;
        let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
        // Longer doubles are rounded; what is no real number is not converted.
        if !["i", "u", "f"].contains(&kind.as_str()) {
            return Err(refused());
        }
        let array = array.call_method1("astype", ("float64",))?;
        let array = array.cast_into::<PyArrayDyn<f64>>()?;
        let shape = array.shape().to_vec();
        let values = array.readonly().as_array().iter().copied().collect();
        Ok(Self { values, shape: (!shape.is_empty()).then_some(shape) })
    }

    /// Numbers beside these: as many, or one for all.
    pub fn beside(&self, name: &str, given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
        let Self { values, shape } = Self::of(name, given)?;
        match shape {
            None => Ok(vec![values[0]; self.values.len()]),
            shape if shape == self.shape => Ok(values),
            Some(shape) => Err(raised(format!(
                "{name}: an array of shape {shape:?} beside one of {:?}: allowed is the same shape, or one number",
                self.shape.as_deref().unwrap_or(&[])
            ))),
        }
    }

    /// What a function is at each of the numbers, without Python's lock where they are many.
    pub fn map<T: Send, E: std::fmt::Display + Send>(
        &self,
        py: Python<'_>,
        function: impl Fn(usize, f64) -> Result<T, E> + Sync,
    ) -> PyResult<Vec<T>> {
        if let [value] = self.values[..] {
            return Ok(vec![function(0, value).map_err(raised)?]);
        }
        let mut found = Vec::with_capacity(self.values.len());
        for (block, values) in self.values.chunks(AT_ONCE).enumerate() {
            py.check_signals()?;
            let first = block * AT_ONCE;
            let fill = |found: &mut Vec<T>| {
                for (k, value) in values.iter().enumerate() {
                    found.push(function(first + k, *value)?);
                }
                Ok(())
            };
            py.detach(|| fill(&mut found)).map_err(raised::<E>)?;
        }
        Ok(found)
    }

    /// Values, `parts` of them for each of the numbers, in the shape of the numbers with the axes of the parts behind.
    pub fn shaped<'py>(&self, py: Python<'py>, values: Vec<f64>, parts: &[usize]) -> PyResult<Bound<'py, PyAny>> {
        let mut shape = match &self.shape {
            None if parts.is_empty() => return Ok(PyFloat::new(py, values[0]).into_any()),
            None => Vec::new(),
            Some(shape) => shape.clone(),
        };
        shape.extend(parts);
        let array = PyArray1::from_vec(py, values);
        if shape.len() == 1 { Ok(array.into_any()) } else { Ok(array.reshape(shape)?.into_any()) }
    }
}

/// A function of several numbers at each element of its arguments, which are scalars or arrays that numpy broadcasts.
pub fn broadcast<'py, const N: usize>(
    py: Python<'py>,
    arguments: [(&str, &Bound<'py, PyAny>); N],
    function: impl Fn([f64; N]) -> Result<f64, twofold::Error> + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let read = arguments.iter().map(|(name, given)| Numbers::of(name, given)).collect::<PyResult<Vec<_>>>()?;
    if read.iter().all(|numbers| numbers.shape.is_none()) {
        return Ok(PyFloat::new(py, function(core::array::from_fn(|k| read[k].values[0])).map_err(raised)?).into_any());
    }
    let given = pyo3::types::PyTuple::new(py, arguments.iter().map(|(_, given)| *given))?;
    let whole = py.import("numpy")?.getattr("broadcast_arrays")?.call1(given).map_err(raised)?;
    let whole = whole.try_iter()?.map(|one| Numbers::of("argument", &one?)).collect::<PyResult<Vec<_>>>()?;
    let found = whole[0].map(py, |k, _| function(core::array::from_fn(|part| whole[part].values[k])))?;
    whole[0].shaped(py, found, &[])
}

/// A list of numbers, of one dimension.
pub fn list(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let numbers = Numbers::of(name, given)?;
    match numbers.shape {
        Some(shape) if shape.len() == 1 => Ok(numbers.values),
        _ => Err(raised(format!("{name}: allowed is an array of one dimension"))),
    }
}
