//! Reads tables of motions from Python objects.

use super::capsule;
use crate::arrays::{kind, numpy_array};
use crate::errors::{input_error, input_error_from, run_catching_panics, wrong_type_error};
use arrow_array::{
    Array, ArrayRef, Int64Array, RecordBatch, RecordBatchIterator, RecordBatchReader, StringArray,
};
use arrow_schema::{ArrowError, Field, Schema};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyMapping, PyString};
use pyo3_arrow::PyRecordBatchReader;
use pyo3_arrow::buffer::AnyBufferProtocol;
use std::iter::from_fn;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

/// A reader of a table, which returns one batch of rows at a time.
pub(crate) type Reader = Box<dyn RecordBatchReader + Send>;

/// Opens any object with the Arrow PyCapsule protocol, or a dict of arrays. Columns are not copied, except for arrays
/// that are not contiguous float64.
pub(crate) fn open(motions: &Bound<'_, PyAny>) -> PyResult<Reader> {
    run_catching_panics("motions", || open_without_catching_panics(motions))
}

fn open_without_catching_panics(motions: &Bound<'_, PyAny>) -> PyResult<Reader> {
    let failed = |error| input_error_from(motions.py(), "motions", error);
    if motions.hasattr("__arrow_c_stream__")? {
        let read = |table: &Bound<'_, PyAny>| {
            let reader = table.extract::<PyRecordBatchReader>();
            let reader = reader.and_then(PyRecordBatchReader::into_reader);
            reader.map(catch_reader_panics).map_err(failed)
        };
        return match library_of_frame(motions)?.as_deref() {
            Some("pandas") => read(&frame_with_index_reset(motions)?),
            Some("polars") => read(&frame_without_null_types(motions)?),
            _ => read(motions),
        };
    }
    if motions.hasattr("__arrow_c_array__")? {
        return Ok(reader_of_batch(capsule::batch(motions).map_err(failed)?));
    }
    match motions.cast::<PyMapping>() {
        Ok(columns) => Ok(reader_of_batch(batch_of_arrays(columns)?)),
        Err(_) => Err(wrong_type_error(
            "motions",
            "an Arrow table (pyarrow, polars, pandas, duckdb, ...) or a dict of arrays",
            motions,
        )),
    }
}

/// Wraps a reader so that it returns an error instead of a panic. Readers panic if a batch does not fit its schema, or
/// an error has no message.
fn catch_reader_panics(mut reader: Reader) -> Reader {
    let schema = reader.schema();
    let next = move || {
        let batch = catch_unwind(AssertUnwindSafe(|| reader.next()));
        batch.unwrap_or_else(|_| {
            let text = "a batch does not fit the schema of its stream, or the stream failed";
            let text = text.to_owned();
            Some(Err(ArrowError::SchemaError(text)))
        })
    };
    Box::new(RecordBatchIterator::new(from_fn(next), schema))
}

/// Returns the name of the library that defines a data frame's class or base class, or `None` for other objects.
fn library_of_frame(motions: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    for class in motions.get_type().mro() {
        let module: String = class.getattr("__module__")?.extract()?;
        let name: String = class.getattr("__name__")?.extract()?;
        if name == "DataFrame" {
            return Ok(module.split('.').next().map(str::to_owned));
        }
    }
    Ok(None)
}

/// Returns a polars frame with its columns of type null cast to another type. Arrow arrays of type null have no
/// buffers, but polars makes them with one.
fn frame_without_null_types<'py>(frame: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let polars = frame.py().import("polars")?;
    let types = PyDict::new(frame.py());
    for column in frame.getattr("schema")?.call_method0("items")?.try_iter()? {
        let (name, kind): (String, Bound<'_, PyAny>) = column?.extract()?;
        if kind.eq(polars.getattr("Null")?)? {
            let as_kind = if name == ID_COLUMN {
                "String"
            } else {
                "Float64"
            };
            types.set_item(name, polars.getattr(as_kind)?)?;
        }
    }
    if types.is_empty() {
        Ok(frame.clone())
    } else {
        frame.call_method1("cast", (types,))
    }
}

/// Returns a pandas frame without an index. An index with a name becomes a column, and other indices are dropped.
fn frame_with_index_reset<'py>(frame: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let names = frame.getattr("index")?.getattr("names")?;
    let names: Vec<_> = names.try_iter()?.collect::<PyResult<_>>()?;
    let options = PyDict::new(frame.py());
    options.set_item("drop", names.iter().all(|name| name.is_none()))?;
    frame.call_method("reset_index", (), Some(&options))
}

/// Returns the expected number of answers, or `None` if the table does not know its number of rows, or has paths.
pub(crate) fn expected_answer_count(motions: &Bound<'_, PyAny>, reader: &Reader) -> Option<usize> {
    if reader.schema().field_with_name(TIME_COLUMN).is_ok() {
        return None;
    }
    match motions.cast::<PyMapping>() {
        Ok(columns) => columns.values().ok()?.get_item(0).ok()?.len().ok(),
        Err(_) => motions.len().ok(),
    }
}

/// The name of the column of ids.
pub(crate) const ID_COLUMN: &str = "id";
/// The name of the column of times in a table of paths.
pub(crate) const TIME_COLUMN: &str = "t";

fn reader_of_batch(batch: RecordBatch) -> Reader {
    let schema = batch.schema();
    Box::new(RecordBatchIterator::new([Ok(batch)], schema))
}

fn batch_of_arrays(columns: &Bound<'_, PyMapping>) -> PyResult<RecordBatch> {
    let mut fields = Vec::new();
    let mut arrays: Vec<ArrayRef> = Vec::new();
    for item in columns.items()? {
        let (name, values): (String, Bound<'_, PyAny>) = item.extract()?;
        let array = read_column(&name, &values)?;
        if let Some(first) = arrays.first().filter(|first| first.len() != array.len()) {
            return Err(input_error(format!(
                "column {name}: has {} rows, but the first column has {}",
                array.len(),
                first.len()
            )));
        }
        fields.push(Field::new(name, array.data_type().clone(), true));
        arrays.push(array);
    }
    if arrays.is_empty() {
        return Err(input_error("motions: there is no column"));
    }
    RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).map_err(input_error)
}

fn read_column(name: &str, values: &Bound<'_, PyAny>) -> PyResult<ArrayRef> {
    let argument_name = format!("column {name}");
    let numpy = values.py().import("numpy")?;
    if name == ID_COLUMN && !values.is_instance(&numpy.getattr("ndarray")?)? {
        return ids(values);
    }
    let array = numpy_array(values, &argument_name)?;
    let dimensions: usize = array.getattr("ndim")?.extract()?;
    if dimensions != 1 {
        return Err(input_error(format!(
            "{argument_name}: an array of one dimension is needed, not of {dimensions}"
        )));
    }
    let dtype = array.getattr("dtype")?;
    match (name, kind(&array)?) {
        (_, 'i' | 'u') => contiguous_array(&array, &dtype.call_method1("newbyteorder", ("=",))?),
        (ID_COLUMN, _) => ids(&array.call_method0("tolist")?),
        (_, 'f') => contiguous_array(&array, PyString::new(values.py(), "float64").as_any()),
        _ => Err(input_error(format!(
            "{argument_name}: numbers are needed, not {dtype}"
        ))),
    }
}

/// Reads ids. They must be all texts or all whole numbers. None stands for a row without an id.
fn ids(values: &Bound<'_, PyAny>) -> PyResult<ArrayRef> {
    let (mut texts, mut numbers) = (Vec::new(), Vec::new());
    for id in values.try_iter()? {
        let id = id?;
        let text: Option<String> = id.extract().ok();
        // Avoids failed conversions: the exception takes longer than the rest of a row.
        let number: Option<i64> = if text.is_some() || id.is_instance_of::<PyBool>() {
            None
        } else {
            id.extract().ok()
        };
        if !id.is_none() && text.is_none() && number.is_none() {
            return Err(wrong_type_error(
                "column id",
                "text or a whole number of 64 bits",
                &id,
            ));
        }
        texts.push(text);
        numbers.push(number);
    }
    match (
        texts.iter().flatten().count(),
        numbers.iter().flatten().count(),
    ) {
        (texts, numbers) if texts > 0 && numbers > 0 => Err(input_error(
            "column id: some ids are text, and some are numbers; convert all to text",
        )),
        (0, 1..) => Ok(Arc::new(Int64Array::from(numbers))),
        _ => Ok(Arc::new(StringArray::from(texts))),
    }
}

/// Returns a contiguous array of the type `dtype`, without a copy if possible.
fn contiguous_array(array: &Bound<'_, PyAny>, dtype: &Bound<'_, PyAny>) -> PyResult<ArrayRef> {
    let numpy = array.py().import("numpy")?;
    let plain = numpy.call_method1("require", (array, dtype, ["C", "A"]))?;
    let buffer: AnyBufferProtocol = plain.extract()?;
    Ok(buffer.into_arrow_array()?)
}
