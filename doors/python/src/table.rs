//! The Python class `Table`, whose columns are Arrow arrays.

pub(crate) mod answering;
mod batch;
mod capsule;
pub(crate) mod input;
mod numpy_column;
mod pieces;
mod results;
mod stored;

pub(crate) use results::path_result_batch;

use crate::arrays::row_indices;
use crate::errors::{input_error as refuse, input_error_or_interrupt, run_catching_panics};
use crate::interruptible::run_interruptibly;
use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, RecordBatch, StructArray};
use arrow_schema::{Field, Schema};
use pyo3::exceptions::{PyKeyError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyCapsule, PyDict, PyList, PyTuple, PyType};
use pyo3_arrow::ffi::{
    ArrayIterator, to_array_pycapsules, to_schema_pycapsule, to_stream_pycapsule,
};
use std::sync::Arc;

/// A table whose columns are Arrow arrays.
///
/// It supports the Arrow PyCapsule protocol: `pyarrow.table(t)`, `polars.DataFrame(t)` and
/// `pandas.DataFrame.from_arrow(t)` take it without a copy, and duckdb queries it by its variable's name. `t["time"]`
/// is a column as a NumPy array. A column of numbers is a read-only view, with NaN in empty cells. A column of text is
/// an array of str and None. `dict(t)` has all columns.
#[pyclass(name = "Table", module = "rigid_ccd", frozen, mapping)]
pub(crate) struct PyTable {
    pub(crate) batch: RecordBatch,
}

#[pymethods]
impl PyTable {
    /// Makes a table from any Arrow table, or from a dict of arrays.
    #[new]
    fn new(py: Python<'_>, table: &Bound<'_, PyAny>) -> PyResult<Self> {
        let reader = input::open(table)?;
        if reader.schema().fields().is_empty() {
            return Err(refuse("table: there is no column"));
        }
        let (batch, interruption) =
            run_interruptibly(py, |stop| batch::read_whole_table(reader, stop), |_| Ok(()))?;
        interruption?;
        let batch = batch.map_err(|error| input_error_or_interrupt(format!("table: {error}")))?;
        Ok(PyTable { batch })
    }

    /// The names of the table's columns, in order.
    #[getter]
    fn column_names(&self) -> Vec<String> {
        batch::header(&self.batch.schema())
    }

    /// Returns the names of the columns, like the keys of a dict.
    fn keys(&self) -> Vec<String> {
        self.column_names()
    }

    /// Returns a table of selected rows: those with the given indices, in that order, or those at which a boolean array
    /// is true.
    fn take(&self, rows: &Bound<'_, PyAny>) -> PyResult<Self> {
        let row_count = self.batch.num_rows();
        let rows = row_indices(rows, row_count)?;
        if let Some(invalid) = rows
            .iter()
            .find(|&&row| !(0..row_count as i64).contains(&row))
        {
            return Err(refuse(format!(
                "row {invalid}: the table has {row_count} rows"
            )));
        }
        let rows = arrow_array::Int64Array::from(rows);
        let batch = run_catching_panics("rows", || {
            arrow_select::take::take_record_batch(&self.batch, &rows).map_err(refuse)
        })?;
        Ok(PyTable { batch })
    }

    /// Returns a table with one column of this table, then all columns of another table of equal length.
    fn _column_before(&self, name: &str, other: &Bound<'_, PyTable>) -> PyResult<Self> {
        let index = self.batch.schema().index_of(name).map_err(refuse)?;
        let (schema, others) = (self.batch.schema(), &other.get().batch);
        let mut fields = vec![Arc::clone(&schema.fields()[index])];
        fields.extend(others.schema().fields().iter().cloned());
        let mut columns = vec![Arc::clone(self.batch.column(index))];
        columns.extend(others.columns().iter().cloned());
        let batch = RecordBatch::try_new(Arc::new(Schema::new(fields)), columns);
        Ok(PyTable {
            batch: batch.map_err(refuse)?,
        })
    }

    /// Makes a table from its pickled form.
    #[classmethod]
    fn _from_bytes(
        class: &Bound<'_, PyType>,
        stored: &Bound<'_, PyBytes>,
        checksum: u32,
    ) -> PyResult<Self> {
        let (py, stored) = (class.py(), stored.as_bytes());
        let batch = run_catching_panics("table", || py.detach(|| stored::read(stored, checksum)))?;
        Ok(PyTable { batch })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, PickledTable<'py>)> {
        let (py, batch) = (slf.py(), &slf.get().batch);
        let stored = run_catching_panics("table", || py.detach(|| stored::write(batch)))?;
        let make = slf.get_type().getattr("_from_bytes")?;
        Ok((make, (PyBytes::new(py, &stored), stored::checksum(&stored))))
    }

    fn __len__(&self) -> usize {
        self.batch.num_rows()
    }

    fn __contains__(&self, name: &str) -> bool {
        self.batch.column_by_name(name).is_some()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, pyo3::types::PyIterator>> {
        PyList::new(py, self.column_names())?.try_iter()
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        match self.batch.column_by_name(name) {
            Some(column) => run_catching_panics(&format!("column {name}"), || {
                numpy_column::to_numpy(py, column)
            }),
            None => {
                let names = self.column_names().join(", ");
                Err(PyKeyError::new_err(format!(
                    "no column {name}; there are {names}"
                )))
            }
        }
    }

    /// Refuses the conversion to an array, because NumPy and pandas would take the column names as values.
    #[pyo3(signature = (*_args, **_how))]
    fn __array__(
        &self,
        _args: &Bound<'_, PyTuple>,
        _how: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        Err(PyTypeError::new_err(
            "a Table is no array; take a column, as table['time'], or pandas.DataFrame.from_arrow(table)",
        ))
    }

    fn __repr__(&self) -> String {
        let (rows, columns) = (self.batch.num_rows(), self.batch.num_columns());
        format!(
            "Table({rows} rows, {columns} columns{})",
            self.describe_status_counts()
        )
    }

    /// Returns the names and types of the columns, as an Arrow schema.
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        Ok(to_schema_pycapsule(py, self.batch.schema().as_ref())?)
    }

    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_array__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let (field, columns) = self.as_struct();
        Ok(to_array_pycapsules(py, field, &columns, requested_schema)?)
    }

    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let (field, columns) = self.as_struct();
        let columns: ArrayRef = Arc::new(columns);
        let reader = ArrayIterator::new([Ok(columns)], field);
        Ok(to_stream_pycapsule(py, Box::new(reader), requested_schema)?)
    }
}

/// The pickled form of a table, with its checksum.
type PickledTable<'py> = (Bound<'py, PyBytes>, u32);

impl PyTable {
    fn as_struct(&self) -> (Arc<Field>, StructArray) {
        let columns = StructArray::from(self.batch.clone());
        let field = Field::new("", columns.data_type().clone(), false);
        let metadata = self.batch.schema().metadata().clone();
        (Arc::new(field.with_metadata(metadata)), columns)
    }

    /// Returns a text with the number of rows of each status. It is empty for a table without statuses.
    fn describe_status_counts(&self) -> String {
        let column = self.batch.column_by_name("status");
        let Some(column) = column.and_then(|column| column.as_string_opt::<i32>()) else {
            return String::new();
        };
        let mut counts: Vec<(&str, usize)> = Vec::new();
        for status in column.iter().flatten() {
            match counts.iter_mut().find(|(name, _)| *name == status) {
                Some((_, count)) => *count += 1,
                None => counts.push((status, 1)),
            }
        }
        counts
            .iter()
            .map(|(name, count)| format!(", {count} {name}"))
            .collect()
    }
}
