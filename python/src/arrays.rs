//! Numbers from Python and back: a scalar or an array of any shape.

use numpy::{PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt, PyTuple};
use pyo3::{Borrowed, type_hint_identifier, type_hint_subscript};

use crate::error::raised;
use crate::interrupt::in_parts;

/// A scalar or an array from Python.
pub struct Numbers {
    pub values: Vec<f64>,
    /// `None` for a scalar.
    shape: Option<Vec<usize>>,
}

impl<'py> FromPyObject<'_, 'py> for Numbers {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = type_hint_identifier!("numpy.typing", "ArrayLike");

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(number) = given.cast::<PyFloat>() {
            return Ok(Self { values: vec![number.value()], shape: None });
        }
        if given.cast_exact::<PyInt>().is_ok() {
            return Ok(Self { values: vec![given.extract()?], shape: None });
        }
        let py = given.py();
        let refused = || PyTypeError::new_err("must be a real number or an array of real numbers");
        let numpy = py.import(pyo3::intern!(py, "numpy"))?;
        if given.hasattr(pyo3::intern!(py, "mask"))? {
            return Err(PyTypeError::new_err("must be an array without a mask"));
        }
        let array = numpy.call_method1(pyo3::intern!(py, "asarray"), (given,)).map_err(|_| refused())?;
        let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
        // Longer floats are rounded; other types than real numbers are refused.
        if !["i", "u", "f"].contains(&kind.as_str()) {
            return Err(refused());
        }
        let array = match array.cast_into::<PyArrayDyn<f64>>() {
            Ok(array) => array,
            Err(other) => other.into_inner().call_method1("astype", ("float64",))?.cast_into()?,
        };
        let (shape, read) = (array.shape().to_vec(), array.readonly());
        let values = match read.as_slice() {
            Ok(values) if array.is_c_contiguous() => values.to_vec(),
            _ => read.as_array().iter().copied().collect(),
        };
        Ok(Self { values, shape: (!shape.is_empty()).then_some(shape) })
    }
}

impl Numbers {
    /// The number, if it has no shape.
    pub fn scalar(&self) -> Option<f64> {
        self.shape.is_none().then(|| self.values[0])
    }

    /// The numbers of `other`, called `name`, for each of these: as many, or one for all.
    pub fn beside(&self, name: &str, other: Self) -> PyResult<Vec<f64>> {
        match other.shape {
            None => Ok(vec![other.values[0]; self.values.len()]),
            shape if shape == self.shape => Ok(other.values),
            Some(shape) => Err(raised(format!(
                "{name} has the shape {shape:?}: must be one number, or have the shape {:?}",
                self.shape.as_deref().unwrap_or(&[])
            ))),
        }
    }

    /// A list of numbers called `name`, of one dimension.
    pub fn list(self, name: &str) -> PyResult<Vec<f64>> {
        match self.shape {
            Some(shape) if shape.len() == 1 => Ok(self.values),
            _ => Err(raised(format!("{name}: must be an array of one dimension"))),
        }
    }

    /// `count` numbers called `name`, from a list of that length or from one number for all.
    pub fn list_of(self, name: &str, count: usize) -> PyResult<Vec<f64>> {
        if self.shape.is_none() {
            return Ok(vec![self.values[0]; count]);
        }
        let found = self.list(name)?;
        if found.len() == count {
            return Ok(found);
        }
        Err(raised(format!(
            "{name} has the length {}: must be one number, or have the length {count} of the times",
            found.len()
        )))
    }

    /// A function at each of the numbers, without Python's lock if they are many. One value takes microseconds.
    pub fn map<T: Send, E: std::fmt::Display + Send>(
        &self,
        py: Python<'_>,
        mut function: impl FnMut(usize, f64) -> Result<T, E> + Send,
    ) -> PyResult<Vec<T>> {
        match self.values[..] {
            [value] => Ok(vec![function(0, value).map_err(raised)?]),
            _ => self.map_long(py, function),
        }
    }

    /// As `map`, if even one value can take long.
    pub fn map_long<T: Send, E: std::fmt::Display + Send>(
        &self,
        py: Python<'_>,
        mut function: impl FnMut(usize, f64) -> Result<T, E> + Send,
    ) -> PyResult<Vec<T>> {
        let mut found = Vec::with_capacity(self.values.len());
        in_parts(py, self.values.len(), |part| {
            for k in part {
                found.push(function(k, self.values[k])?);
            }
            Ok::<_, E>(())
        })?;
        Ok(found)
    }

    /// Values, `parts` for each of the numbers, in the shape of the numbers followed by the axes of the parts.
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

/// A function of several numbers at each element of its arguments, which numpy broadcasts.
pub fn broadcast<'py, const N: usize>(
    py: Python<'py>,
    arguments: [Numbers; N],
    function: impl Fn([f64; N]) -> Result<f64, twofold::Error> + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let mut arguments = Vec::from(arguments);
    let shape = arguments.iter().find_map(|numbers| numbers.shape.clone());
    if arguments.iter().any(|numbers| numbers.shape.is_some() && numbers.shape != shape) {
        let given = arguments.into_iter().map(|Numbers { values, shape }| {
            let numbers = Numbers { values: Vec::new(), shape };
            numbers.shaped(py, values, &[])
        });
        let given = PyTuple::new(py, given.collect::<PyResult<Vec<_>>>()?)?;
        let same = py.import("numpy")?.getattr("broadcast_arrays")?.call1(given).map_err(raised)?;
        arguments = same.try_iter()?.map(|one| one?.extract::<Numbers>()).collect::<PyResult<Vec<_>>>()?;
    }
    let at = |part: &Numbers, k: usize| if part.shape.is_some() { part.values[k] } else { part.values[0] };
    let whole = arguments.iter().find(|numbers| numbers.shape.is_some()).unwrap_or(&arguments[0]);
    let found = whole.map(py, |k, _| function(core::array::from_fn(|part| at(&arguments[part], k))))?;
    whole.shaped(py, found, &[])
}

/// An array of float64, for the stubs.
pub struct Array<'py>(pub Bound<'py, PyAny>);

impl<'py> IntoPyObject<'py> for Array<'py> {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    const OUTPUT_TYPE: PyStaticExpr = type_hint_subscript!(
        type_hint_identifier!("numpy.typing", "NDArray"),
        type_hint_identifier!("numpy", "float64")
    );

    fn into_pyobject(self, _: Python<'py>) -> PyResult<Self::Output> {
        Ok(self.0)
    }
}

/// An array of one dimension.
pub fn array<'py>(py: Python<'py>, values: impl IntoIterator<Item = f64>) -> Array<'py> {
    Array(PyArray1::from_vec(py, values.into_iter().collect()).into_any())
}
