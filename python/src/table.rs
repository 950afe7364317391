//! Tables: columns by name, as the command writes them.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{ArrayRef, Float64Array, RecordBatch, RecordBatchIterator, StringArray};
use arrow_schema::{DataType, Field, Schema};
use numpy::PyArray1;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyCapsule, PyDict, PyIterator, PyList};
use twofold_scene::read_table::{Column, Values, columns_of};

use crate::error::raised;

/// A table of numbers, a column for each name. A missing number is NaN.
///
/// `table["beta"]` is an array, `table.units["beta"]` its unit, `table.csv` the bytes that the command would write; `dict(table)` has all columns. polars and pyarrow
/// read it by the Arrow PyCapsule interface, as `polars.DataFrame(table)`, and so does pandas where pyarrow is installed, as `pandas.DataFrame.from_arrow(table)`.
#[pyclass(frozen, module = "twofold")]
pub struct Table {
    pub(crate) csv: Vec<u8>,
    columns: Vec<Column>,
    rows: usize,
}

impl Table {
    /// A table written as CSV.
    pub fn of_csv(csv: Vec<u8>) -> Result<Self, String> {
        let (columns, rows) = columns_of(&csv)?;
        let mut names = HashSet::new();
        if let Some(twice) = columns.iter().find(|column| !names.insert(&column.name)) {
            return Err(format!("two columns have the name `{}`", twice.name));
        }
        Ok(Self { csv, columns, rows })
    }
}

fn array(column: &Column) -> ArrayRef {
    match &column.values {
        Values::Numbers(numbers) => Arc::new(Float64Array::from(numbers.clone())),
        Values::Words(words) => Arc::new(StringArray::from_iter_values(words)),
    }
}

#[pymethods]
impl Table {
    /// A table from the bytes of `csv`.
    #[new]
    fn new(csv: &[u8]) -> PyResult<Self> {
        Self::of_csv(csv.to_owned()).map_err(raised)
    }

    /// The names of the columns.
    fn keys(&self) -> Vec<&str> {
        self.columns.iter().map(|column| column.name.as_str()).collect()
    }

    /// The unit of each column.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let units = PyDict::new(py);
        self.columns.iter().try_for_each(|column| units.set_item(&column.name, &column.unit))?;
        Ok(units)
    }

    /// Comma-separated values, as the command writes them.
    #[getter]
    fn csv<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.csv)
    }

    /// A column: an array of float64, or a list of words.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let found = self.columns.iter().find(|column| column.name == name);
        match found.map(|column| &column.values) {
            Some(Values::Numbers(numbers)) => Ok(PyArray1::from_slice(py, numbers).into_any()),
            Some(Values::Words(words)) => Ok(PyList::new(py, words)?.into_any()),
            None => Err(PyKeyError::new_err(format!(
                "`{name}` is not a column; expected one of {}",
                self.keys().join(", ")
            ))),
        }
    }

    fn __contains__(&self, name: &str) -> bool {
        self.columns.iter().any(|column| column.name == name)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        PyList::new(py, self.keys())?.try_iter()
    }

    fn __len__(&self) -> usize {
        self.rows
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.csv == other.csv
    }

    fn __repr__(&self) -> String {
        format!("Table of {} rows: {}", self.rows, self.keys().join(", "))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (Bound<'py, PyBytes>,)) {
        (slf.get_type().into_any(), (slf.get().csv(slf.py()),))
    }

    /// The table as an Arrow stream. A `requested_schema` is not followed: consumers cast.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let _ = requested_schema;
        let field = |column: &Column| {
            let kind = if matches!(column.values, Values::Numbers(_)) { DataType::Float64 } else { DataType::Utf8 };
            let unit = HashMap::from([("unit".to_owned(), column.unit.clone())]);
            Field::new(&column.name, kind, false).with_metadata(unit)
        };
        let schema = Arc::new(Schema::new(self.columns.iter().map(field).collect::<Vec<_>>()));
        let batch = RecordBatch::try_new(schema.clone(), self.columns.iter().map(array).collect()).map_err(raised)?;
        let stream = FFI_ArrowArrayStream::new(Box::new(RecordBatchIterator::new([Ok(batch)], schema)));
        // Stubs have capsules only from Python 3.13 on.
        Ok(PyCapsule::new_with_value(py, stream, c"arrow_array_stream")?.into_any())
    }
}
