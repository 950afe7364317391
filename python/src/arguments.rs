//! Arguments: a number or a list of names.

use pyo3::Borrowed;
use pyo3::exceptions::PyTypeError;
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyString};

use crate::arrays::Numbers;
use crate::error::raised;

/// One real number from Python or numpy. A boolean is refused.
#[derive(Clone, Copy)]
pub struct Number(pub f64);

impl<'py> FromPyObject<'_, 'py> for Number {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = f64::INPUT_TYPE;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let refused = || PyTypeError::new_err("must be a real number");
        if given.is_instance_of::<PyBool>() {
            return Err(refused());
        }
        match given.extract::<Numbers>() {
            Ok(numbers) => numbers.scalar().map(Self).ok_or_else(refused),
            // Another number type, such as `Fraction`, is accepted; an array has its own error.
            Err(_) if !given.hasattr("dtype")? => given.extract().map(Self).map_err(|_| refused()),
            Err(error) if error.is_instance_of::<PyTypeError>(given.py()) => Err(refused()),
            Err(error) => Err(error),
        }
    }
}

/// The same for an argument with a default.
pub fn number(given: &Bound<'_, PyAny>) -> PyResult<f64> {
    given.extract().map(|Number(number)| number)
}

/// A list of names.
pub struct Names(pub Vec<String>);

impl<'py> FromPyObject<'_, 'py> for Names {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = Vec::<String>::INPUT_TYPE;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(text) = given.cast::<PyString>() {
            return Err(PyTypeError::new_err(format!("must be a list of names, not the text {}", text.repr()?)));
        }
        given.extract().map(Self)
    }
}

impl Names {
    /// The names as the command's list. Names that would be a different list there are refused. `argument` is the name of the argument.
    pub fn listed(&self, argument: &str) -> PyResult<String> {
        if self.0.is_empty() {
            return Err(raised(format!("{argument}: must be a list of at least one name")));
        }
        match self.0.iter().find(|name| name.contains([',', ':'])) {
            Some(name) => Err(raised(format!("{argument}: `{name}` must be a single name, without `,` or `:`"))),
            None => Ok(self.0.join(",")),
        }
    }
}

/// A message of the command with Python's arguments in place of the command's options.
pub fn by_arguments(message: impl ToString) -> PyErr {
    let options = [
        ("--simulate or strains", "strains"),
        ("--observe", "observe"),
        ("--parameters", "parameters"),
        ("--causes", "causes"),
    ];
    raised(options.iter().fold(message.to_string(), |text, (option, argument)| text.replace(option, argument)))
}
