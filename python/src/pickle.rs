//! How a pickled object is restored.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// The result of `__reduce__`: a callable and its arguments.
pub type Reduced<'py> = (Bound<'py, PyAny>, Bound<'py, PyTuple>);

/// A call with these keyword arguments.
pub fn called_with<'py>(callable: Bound<'py, PyAny>, options: &Bound<'py, PyDict>) -> PyResult<Reduced<'py>> {
    let py = options.py();
    let partial = py.import("functools")?.getattr("partial")?.call((callable,), Some(options))?;
    Ok((partial, PyTuple::empty(py)))
}
