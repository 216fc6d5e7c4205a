//! Converts a column to a NumPy array.

use crate::errors::{input_error as refuse, input_error_from};
use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, Float64Array};
use arrow_cast::cast;
use arrow_schema::DataType;
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3_arrow::PyArray;
use pyo3_arrow::buffer::PyArrowBuffer;

/// Converts a column to an array: numbers to a view, other values to an array of objects.
///
/// Empty cells are NaN in columns of float64, and of whole numbers that float64 can represent.
pub(crate) fn to_numpy<'py>(py: Python<'py>, column: &ArrayRef) -> PyResult<Bound<'py, PyAny>> {
    match column.data_type() {
        DataType::Float64 => floats_to_numpy(py, column.as_primitive()),
        DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View => text_array(py, column),
        _ if column.null_count() > 0 => array_with_empty_cells(py, column),
        DataType::Float32 => number_view(py, column),
        data_type if data_type.is_integer() => number_view(py, column),
        _ => object_array(py, column),
    }
}

fn floats_to_numpy<'py>(py: Python<'py>, numbers: &Float64Array) -> PyResult<Bound<'py, PyAny>> {
    let mut rows = 0..numbers.len();
    let is_nan = |row| numbers.is_valid(row) || numbers.value(row).is_nan();
    if numbers.null_count() == 0 || rows.all(is_nan) {
        let column: ArrayRef = std::sync::Arc::new(numbers.clone());
        return number_view(py, &column);
    }
    let values: Vec<f64> = numbers
        .iter()
        .map(|cell| cell.unwrap_or(f64::NAN))
        .collect();
    Ok(numpy::PyArray1::from_vec(py, values).into_any())
}

/// Returns a view of a column of numbers. Null cells have arbitrary values.
fn number_view<'py>(py: Python<'py>, column: &ArrayRef) -> PyResult<Bound<'py, PyAny>> {
    let numpy = py.import("numpy")?;
    // Arrow and NumPy have the same names for these types, except for capital letters.
    let dtype = column.data_type().to_string().to_lowercase();
    match column.len() {
        // NumPy does not accept an empty buffer.
        0 => numpy.call_method1("empty", (0, dtype)),
        rows => {
            let buffer = PyArrowBuffer::new(column.to_data().buffers()[0].clone());
            numpy.call_method1("frombuffer", (buffer, dtype, rows))
        }
    }
}

fn array_with_empty_cells<'py>(py: Python<'py>, column: &ArrayRef) -> PyResult<Bound<'py, PyAny>> {
    if column.data_type().is_integer() {
        let wide = cast(column, &DataType::Float64).map_err(refuse)?;
        let wide: &Float64Array = wide.as_primitive();
        // Beyond 2^53, float64 cannot represent all integers.
        let most = (1_u64 << 53) as f64;
        if wide.iter().flatten().all(|whole| whole.abs() < most) {
            return floats_to_numpy(py, wide);
        }
    }
    object_array(py, column)
}

fn text_array<'py>(py: Python<'py>, column: &ArrayRef) -> PyResult<Bound<'py, PyAny>> {
    let texts = cast(column, &DataType::LargeUtf8).map_err(refuse)?;
    let texts: Vec<Option<&str>> = texts.as_string::<i64>().iter().collect();
    py.import("numpy")?.call_method1("array", (texts, "object"))
}

fn object_array<'py>(py: Python<'py>, column: &ArrayRef) -> PyResult<Bound<'py, PyAny>> {
    if let Some(data_type) = unconvertible_type(column.data_type()) {
        return Err(refuse(format!(
            "values of type {data_type} have no Python objects; convert the table through Arrow, as in pyarrow.table(t)"
        )));
    }
    // Reserves all memory first: an array of nulls may claim a length that exceeds memory.
    let mut memory = Vec::<usize>::new();
    if memory.try_reserve_exact(column.len()).is_err() {
        let rows = column.len();
        return Err(PyMemoryError::new_err(format!(
            "{rows} rows do not fit into memory"
        )));
    }
    let array = Bound::new(py, PyArray::from_array_ref(ArrayRef::clone(column)))?;
    let values = array
        .call_method0("to_pylist")
        .map_err(|error| input_error_from(py, "a value", error))?;
    // NumPy would convert nested lists to an array with more dimensions.
    let objects = py
        .import("numpy")?
        .call_method1("empty", (column.len(), "object"))?;
    objects.set_item(pyo3::types::PySlice::full(py), values)?;
    Ok(objects)
}

/// Returns the type, nested in a column's type, that `to_pylist` cannot convert, or `None` if it can convert all.
fn unconvertible_type(data_type: &DataType) -> Option<&DataType> {
    match data_type {
        DataType::ListView(_)
        | DataType::LargeListView(_)
        | DataType::Interval(_)
        | DataType::RunEndEncoded(..) => Some(data_type),
        DataType::Map(entries, _) => match entries.data_type() {
            DataType::Struct(fields)
                if ["key", "value"]
                    .iter()
                    .all(|name| fields.find(name).is_some()) =>
            {
                unconvertible_type(entries.data_type())
            }
            _ => Some(data_type),
        },
        DataType::List(values)
        | DataType::LargeList(values)
        | DataType::FixedSizeList(values, _) => unconvertible_type(values.data_type()),
        DataType::Dictionary(_, values) => unconvertible_type(values),
        DataType::Struct(fields) => fields
            .iter()
            .find_map(|field| unconvertible_type(field.data_type())),
        DataType::Union(fields, _) => fields
            .iter()
            .find_map(|(_, field)| unconvertible_type(field.data_type())),
        _ => None,
    }
}
