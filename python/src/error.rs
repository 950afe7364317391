//! Errors as Python's exceptions, with the messages of the command.

use std::fmt::Display;

use pyo3::PyErr;
use pyo3::exceptions::PyValueError;

pyo3::create_exception!(
    twofold,
    Error,
    PyValueError,
    "Input that is not allowed, or a computation that could not be completed. The message names the quantity, its value and what it must be."
);

/// The exception with the message of an error.
pub fn raised<E: Display>(error: E) -> PyErr {
    Error::new_err(error.to_string())
}
