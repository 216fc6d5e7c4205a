//! Tables of motions, as Python has them.

use crate::errors::{input, wrong_type};
use arrow_array::{ArrayRef, RecordBatch, RecordBatchIterator, RecordBatchReader, StringArray};
use arrow_schema::{Field, Schema};
use pyo3::prelude::*;
use pyo3::types::PyMapping;
use pyo3_arrow::buffer::AnyBufferProtocol;
use pyo3_arrow::{PyRecordBatch, PyRecordBatchReader};
use std::sync::Arc;

/// A table, batch by batch.
pub(crate) type Reader = Box<dyn RecordBatchReader + Send>;

/// Opens anything that speaks the Arrow PyCapsule protocol, or a dict of arrays. Columns are not copied, except for
/// arrays that are not contiguous float64.
pub(crate) fn open(motions: &Bound<'_, PyAny>) -> PyResult<Reader> {
    if motions.hasattr("__arrow_c_stream__")? {
        return motions.extract::<PyRecordBatchReader>()?.into_reader();
    }
    if motions.hasattr("__arrow_c_array__")? {
        return Ok(one(motions.extract::<PyRecordBatch>()?.into_inner()));
    }
    match motions.cast::<PyMapping>() {
        Ok(columns) => Ok(one(of_arrays(columns)?)),
        Err(_) => Err(wrong_type(
            "motions",
            "an Arrow table (pyarrow, polars, pandas, duckdb, ...) or a dict of arrays",
            motions,
        )),
    }
}

/// Returns the number of rows, where the table knows it beforehand.
pub(crate) fn rows(motions: &Bound<'_, PyAny>) -> Option<usize> {
    match motions.cast::<PyMapping>() {
        Ok(columns) => columns.values().ok()?.get_item(0).ok()?.len().ok(),
        Err(_) => motions.len().ok(),
    }
}

fn one(batch: RecordBatch) -> Reader {
    let schema = batch.schema();
    Box::new(RecordBatchIterator::new([Ok(batch)], schema))
}

fn of_arrays(columns: &Bound<'_, PyMapping>) -> PyResult<RecordBatch> {
    let mut fields = Vec::new();
    let mut arrays: Vec<ArrayRef> = Vec::new();
    for item in columns.items()? {
        let (name, values): (String, Bound<'_, PyAny>) = item.extract()?;
        let array = column(&name, &values)?;
        if let Some(first) = arrays.first().filter(|first| first.len() != array.len()) {
            return Err(input(format!(
                "column {name}: has {} rows, but the first column has {}",
                array.len(),
                first.len()
            )));
        }
        fields.push(Field::new(name, array.data_type().clone(), true));
        arrays.push(array);
    }
    if arrays.is_empty() {
        return Err(input("motions: there is no column"));
    }
    RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).map_err(input)
}

fn column(name: &str, values: &Bound<'_, PyAny>) -> PyResult<ArrayRef> {
    let py = values.py();
    let numpy = py.import("numpy")?;
    let array = numpy.call_method1("asarray", (values,));
    let array = array.map_err(|error| input(format!("column {name}: {}", error.value(py))))?;
    let dimensions: usize = array.getattr("ndim")?.extract()?;
    if dimensions != 1 {
        return Err(input(format!(
            "column {name}: an array of one dimension is needed, not of {dimensions}"
        )));
    }
    let dtype = array.getattr("dtype")?;
    let kind: String = dtype.getattr("kind")?.extract()?;
    match (name, kind.as_str()) {
        ("id", "i" | "u") => {
            contiguous(&numpy, &array, &dtype.call_method1("newbyteorder", ("=",))?)
        }
        ("id", _) => {
            let texts = array.call_method1("astype", ("str",))?;
            let texts: Vec<String> = texts.call_method0("tolist")?.extract()?;
            Ok(Arc::new(StringArray::from(texts)))
        }
        (_, "f" | "i" | "u") => contiguous(
            &numpy,
            &array,
            pyo3::types::PyString::new(py, "float64").as_any(),
        ),
        _ => Err(input(format!(
            "column {name}: numbers are needed, not {dtype}"
        ))),
    }
}

/// Returns an array of that type, without a copy where it is one already.
fn contiguous(
    numpy: &Bound<'_, PyModule>,
    array: &Bound<'_, PyAny>,
    dtype: &Bound<'_, PyAny>,
) -> PyResult<ArrayRef> {
    let plain = numpy.call_method1("require", (array, dtype, ["C", "A"]))?;
    let buffer: AnyBufferProtocol = plain.extract()?;
    Ok(buffer.into_arrow_array()?)
}
