//! Reads and makes NumPy arrays, with NumPy's conversion rules.

use crate::errors::{input_error, input_error_from};
use numpy::{PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// Reads rows of `N` numbers from anything that NumPy can convert to an array.
pub(crate) fn rows<const N: usize>(
    values: &Bound<'_, PyAny>,
    what: &str,
) -> PyResult<Vec<[f64; N]>> {
    let array = float64_array(values, what)?;
    let array: PyReadonlyArray2<'_, f64> = readonly_matrix(&array, N, what)?;
    let rows = array.as_array();
    Ok(rows
        .rows()
        .into_iter()
        .map(|row| std::array::from_fn(|k| row[k]))
        .collect())
}

/// Reads rows of three vertex indices.
pub(crate) fn triangles(values: &Bound<'_, PyAny>) -> PyResult<Vec<[u32; 3]>> {
    let given = numpy_array(values, "faces")?;
    let size: usize = given.getattr("size")?.extract()?;
    if size > 0 && !matches!(kind(&given)?, 'i' | 'u') {
        let dtype = given.getattr("dtype")?;
        return Err(input_error(format!(
            "faces: indices are integers, not {dtype}"
        )));
    }
    let array = as_array(&given, "int64", "faces")?;
    let array: PyReadonlyArray2<'_, i64> = readonly_matrix(&array, 3, "faces")?;
    let rows = array.as_array();
    let rows = rows.rows().into_iter().enumerate();
    rows.map(|(face, row)| {
        let corner = |index: i64| {
            let refused = |_| input_error(format!("faces: face {face} has the index {index}"));
            u32::try_from(index).map_err(refused)
        };
        Ok([corner(row[0])?, corner(row[1])?, corner(row[2])?])
    })
    .collect()
}

/// Reads exactly `N` finite numbers; the error names the first number that is NaN or infinite.
pub(crate) fn finite_numbers<const N: usize>(
    values: &Bound<'_, PyAny>,
    what: &str,
) -> PyResult<[f64; N]> {
    let found = numbers(values, what)?;
    match found.iter().position(|number| !number.is_finite()) {
        Some(entry) => {
            let number = found[entry];
            let text = format!("{what}: entry {entry} is {number}, no finite number");
            Err(input_error(text))
        }
        None => Ok(found),
    }
}

/// Reads exactly `N` numbers, which may be NaN or infinite.
pub(crate) fn numbers<const N: usize>(values: &Bound<'_, PyAny>, what: &str) -> PyResult<[f64; N]> {
    let found = flat_numbers(values, what)?;
    let length = found.len();
    found
        .try_into()
        .map_err(|_| input_error(format!("{what}: {N} numbers are needed, not {length}")))
}

/// Reads all numbers of an array of any shape as one list.
pub(crate) fn flat_numbers(values: &Bound<'_, PyAny>, what: &str) -> PyResult<Vec<f64>> {
    flat_list(&float64_array(values, what)?)?.extract()
}

/// Reads all whole numbers of an array of any shape as one list.
pub(crate) fn indices(values: &Bound<'_, PyAny>, what: &str) -> PyResult<Vec<i64>> {
    let given = numpy_array(values, what)?;
    let (kind, size) = (kind(&given)?, given.getattr("size")?.extract::<usize>()?);
    if size > 0 && !matches!(kind, 'i' | 'u') {
        return Err(input_error(format!("{what}: whole numbers are needed")));
    }
    flat_list(&as_array(&given, "int64", what)?)?.extract()
}

/// Returns the elements of an array of any shape as a list.
fn flat_list<'py>(array: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    array.call_method0("ravel")?.call_method0("tolist")
}

/// Reads row indices; a boolean array with one element per row stands for the indices of its true elements.
pub(crate) fn row_indices(rows: &Bound<'_, PyAny>, all: usize) -> PyResult<Vec<i64>> {
    let given = numpy_array(rows, "rows")?;
    if kind(&given)? != 'b' {
        return indices(&given, "rows");
    }
    match shape(&given, "rows")?[..] {
        [length] if length == all => {
            let numpy = given.py().import("numpy")?;
            indices(&numpy.call_method1("flatnonzero", (given,))?, "rows")
        }
        ref shape => Err(input_error(format!(
            "rows: an array of {all} bool is needed, not one of shape {shape:?}"
        ))),
    }
}

/// Returns the shape of the array that NumPy makes of some values.
pub(crate) fn shape(values: &Bound<'_, PyAny>, what: &str) -> PyResult<Vec<usize>> {
    numpy_array(values, what)?.getattr("shape")?.extract()
}

/// Makes an array of values, whose element type NumPy chooses.
pub(crate) fn numpy_array<'py>(
    values: &Bound<'py, PyAny>,
    what: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let py = values.py();
    let numpy = py.import("numpy")?;
    let masked = numpy.getattr("ma")?.call_method1("is_masked", (values,))?;
    if masked.is_truthy()? {
        return Err(input_error(format!(
            "{what}: some values are masked; fill them, or leave them out"
        )));
    }
    let array = numpy.call_method1("asarray", (values,));
    array.map_err(|error| input_error_from(py, what, error))
}

/// Returns NumPy's one-letter code for the kind of an array's elements.
pub(crate) fn kind(array: &Bound<'_, PyAny>) -> PyResult<char> {
    array.getattr("dtype")?.getattr("kind")?.extract()
}

/// Makes an array of float64 elements.
pub(crate) fn float64_array<'py>(
    values: &Bound<'py, PyAny>,
    what: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let given = numpy_array(values, what)?;
    match kind(&given)? {
        // Arrays of objects contain other kinds of numbers, such as fractions.
        'f' | 'i' | 'u' | 'O' => as_array(&given, "float64", what),
        _ => {
            let dtype = given.getattr("dtype")?;
            Err(input_error(format!(
                "{what}: numbers are needed, not {dtype}"
            )))
        }
    }
}

fn as_array<'py>(
    values: &Bound<'py, PyAny>,
    dtype: &str,
    what: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let py = values.py();
    let array = py.import("numpy")?.call_method1("asarray", (values, dtype));
    array.map_err(|error| input_error_from(py, what, error))
}

fn readonly_matrix<'py, T: numpy::Element>(
    array: &Bound<'py, PyAny>,
    columns: usize,
    what: &str,
) -> PyResult<PyReadonlyArray2<'py, T>> {
    let wrong = |shape: &[usize]| {
        input_error(format!(
            "{what}: an array of shape (n, {columns}) is needed, not {shape:?}"
        ))
    };
    let Ok(array) = array.cast::<numpy::PyArray2<T>>() else {
        return Err(wrong(&shape(array, what)?));
    };
    if array.shape()[1] == columns {
        Ok(array.readonly())
    } else {
        Err(wrong(array.shape()))
    }
}
