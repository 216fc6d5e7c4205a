//! Reads NumPy arrays, and other values by NumPy's rules of conversion.

use crate::errors::{input_error, input_error_from};
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};

/// The elements of an array in C order (last index fastest), whatever their order in memory.
pub(crate) struct Elements<T> {
    pub(crate) values: Vec<T>,
    pub(crate) shape: Vec<usize>,
}

impl Elements<f64> {
    /// Reads numbers from anything that NumPy can convert to an array of numbers.
    pub(crate) fn read(values: &Bound<'_, PyAny>, argument_name: &str) -> PyResult<Self> {
        let array = numpy_array(values, argument_name)?;
        match kind(&array)? {
            'f' | 'i' | 'u' => {}
            // Arrays of objects may contain other kinds of numbers, such as fractions.
            'O' => check_objects(&array, argument_name)?,
            _ => {
                let dtype = array.getattr("dtype")?;
                let text = format!("{argument_name}: numbers are needed, not {dtype}");
                return Err(input_error(text));
            }
        }
        elements(&array, "float64", argument_name)
    }
}

impl Elements<i64> {
    /// Reads whole numbers from anything that NumPy can convert to an array of whole numbers.
    pub(crate) fn read(values: &Bound<'_, PyAny>, argument_name: &str) -> PyResult<Self> {
        let array = numpy_array(values, argument_name)?;
        let is_empty = array.getattr("size")?.extract::<usize>()? == 0;
        if !is_empty && !matches!(kind(&array)?, 'i' | 'u') {
            let dtype = array.getattr("dtype")?;
            return Err(input_error(format!(
                "{argument_name}: indices are integers, not {dtype}"
            )));
        }
        elements(&array, "int64", argument_name)
    }
}

impl<T> Elements<T> {
    /// Returns the rows of an array of shape (n, `N`).
    fn rows<const N: usize>(&self, argument_name: &str) -> PyResult<&[[T; N]]> {
        match self.shape[..] {
            [_, columns] if columns == N => Ok(self.values.as_chunks().0),
            ref shape => Err(input_error(format!(
                "{argument_name}: an array of shape (n, {N}) is needed, not {shape:?}"
            ))),
        }
    }
}

/// Copies the elements of a NumPy array.
fn elements<T: Element + Copy>(
    array: &Bound<'_, PyAny>,
    dtype: &str,
    argument_name: &str,
) -> PyResult<Elements<T>> {
    let py = array.py();
    // Converts the elements to the machine's byte order, at aligned addresses.
    let plain = (py.import("numpy")?)
        .call_method1("require", (array, dtype, ["C", "A"]))
        .map_err(|error| input_error_from(py, argument_name, error))?;
    let plain = plain.cast::<PyArrayDyn<T>>()?;
    Ok(Elements {
        values: plain.try_readonly()?.as_array().iter().copied().collect(),
        shape: plain.shape().to_vec(),
    })
}

/// Reads rows of `N` numbers.
pub(crate) fn rows<const N: usize>(
    values: &Bound<'_, PyAny>,
    argument_name: &str,
) -> PyResult<Vec<[f64; N]>> {
    Ok(Elements::<f64>::read(values, argument_name)?
        .rows(argument_name)?
        .to_vec())
}

/// Reads rows of three vertex indices.
pub(crate) fn triangles(values: &Bound<'_, PyAny>) -> PyResult<Vec<[u32; 3]>> {
    let indices = Elements::<i64>::read(values, "faces")?;
    let rows = indices.rows::<3>("faces")?.iter().enumerate();
    rows.map(|(face, row)| {
        let corner = |index: i64| {
            let refused = |_| input_error(format!("faces: face {face} has the index {index}"));
            u32::try_from(index).map_err(refused)
        };
        Ok([corner(row[0])?, corner(row[1])?, corner(row[2])?])
    })
    .collect()
}

/// Reads exactly `N` finite numbers. The error names the first number that is NaN or infinite.
pub(crate) fn finite_numbers<const N: usize>(
    values: &Bound<'_, PyAny>,
    argument_name: &str,
) -> PyResult<[f64; N]> {
    let numbers = numbers(values, argument_name)?;
    match numbers.iter().position(|number| !number.is_finite()) {
        Some(entry) => {
            let number = numbers[entry];
            let text = format!("{argument_name}: entry {entry} is {number}, not a finite number");
            Err(input_error(text))
        }
        None => Ok(numbers),
    }
}

/// Reads exactly `N` numbers, which may be NaN or infinite.
pub(crate) fn numbers<const N: usize>(
    values: &Bound<'_, PyAny>,
    argument_name: &str,
) -> PyResult<[f64; N]> {
    let numbers = flat_numbers(values, argument_name)?;
    let length = numbers.len();
    numbers.try_into().map_err(|_| {
        input_error(format!(
            "{argument_name}: {N} numbers are needed, not {length}"
        ))
    })
}

/// Reads all numbers of an array of any shape as one list.
pub(crate) fn flat_numbers(values: &Bound<'_, PyAny>, argument_name: &str) -> PyResult<Vec<f64>> {
    Ok(Elements::<f64>::read(values, argument_name)?.values)
}

/// Reads all whole numbers of an array of any shape as one list.
fn indices(values: &Bound<'_, PyAny>, argument_name: &str) -> PyResult<Vec<i64>> {
    Ok(Elements::<i64>::read(values, argument_name)?.values)
}

/// Reads row indices. A boolean array with one element for each row stands for the indices of its true elements.
pub(crate) fn row_indices(rows: &Bound<'_, PyAny>, row_count: usize) -> PyResult<Vec<i64>> {
    let array = numpy_array(rows, "rows")?;
    if kind(&array)? != 'b' {
        return indices(&array, "rows");
    }
    match shape(&array, "rows")?[..] {
        [length] if length == row_count => {
            let numpy = array.py().import("numpy")?;
            indices(&numpy.call_method1("flatnonzero", (array,))?, "rows")
        }
        ref shape => Err(input_error(format!(
            "rows: an array of {row_count} bool is needed, not one of shape {shape:?}"
        ))),
    }
}

/// Returns the shape of the array that NumPy makes from values.
pub(crate) fn shape(values: &Bound<'_, PyAny>, argument_name: &str) -> PyResult<Vec<usize>> {
    numpy_array(values, argument_name)?
        .getattr("shape")?
        .extract()
}

/// Converts values to an array. NumPy chooses the element type.
pub(crate) fn numpy_array<'py>(
    values: &Bound<'py, PyAny>,
    argument_name: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let py = values.py();
    let numpy = py.import("numpy")?;
    let array = numpy.call_method1("asarray", (values,));
    let array = array.map_err(|error| input_error_from(py, argument_name, error))?;
    let masked_array = numpy.getattr("ma")?.getattr("MaskedArray")?;
    // NumPy would read the values under a mask, so masked arrays are refused.
    visit_parts(values, array.getattr("ndim")?.extract()?, &mut |part, _| {
        let is_masked = part.is_instance(&masked_array)?
            && part.getattr("mask")?.call_method0("any")?.is_truthy()?;
        if is_masked {
            return Err(input_error(format!(
                "{argument_name}: some values are masked; fill them, or leave them out"
            )));
        }
        Ok(())
    })?;
    Ok(array)
}

/// Returns NumPy's one-letter code for the kind of an array's elements.
pub(crate) fn kind(array: &Bound<'_, PyAny>) -> PyResult<char> {
    array.getattr("dtype")?.getattr("kind")?.extract()
}

/// Calls `visit` with the values, and with each object in their nested lists that is not a number. `depth` is the number
/// of levels below the values, one for each dimension of the array. The second argument of `visit` is the number of levels
/// below the object.
pub(crate) fn visit_parts<'py>(
    values: &Bound<'py, PyAny>,
    depth: usize,
    visit: &mut impl FnMut(&Bound<'py, PyAny>, usize) -> PyResult<()>,
) -> PyResult<()> {
    values.py().check_signals()?;
    visit(values, depth)?;
    if depth == 0 || !is_nested(values)? {
        return Ok(());
    }
    for value in values.try_iter()?.take(values.len()?) {
        let value = value?;
        let is_number = value.is_instance_of::<PyFloat>() || value.is_instance_of::<PyInt>();
        if !is_number {
            visit_parts(&value, depth - 1, visit)?;
        }
    }
    Ok(())
}

/// Returns whether NumPy converts the elements of an object one by one: it is a list, or another sequence that is not
/// an array.
fn is_nested(values: &Bound<'_, PyAny>) -> PyResult<bool> {
    if values.is_instance_of::<PyList>() || values.is_instance_of::<PyTuple>() {
        return Ok(true);
    }
    let is_text = values.is_instance_of::<PyString>() || values.is_instance_of::<PyBytes>();
    Ok(!is_text
        && !values.is_instance_of::<PyDict>()
        && !values.hasattr("__array__")?
        && values.hasattr("__len__")?
        && values.hasattr("__getitem__")?)
}

/// Returns an error for an object that NumPy would convert to a number although it is none: text, a truth value or None.
fn check_objects(array: &Bound<'_, PyAny>, argument_name: &str) -> PyResult<()> {
    let numpy_bool = array.py().import("numpy")?.getattr("bool")?;
    for value in array.getattr("flat")?.try_iter()? {
        let value = value?;
        let is_text = value.is_instance_of::<PyString>() || value.is_instance_of::<PyBytes>();
        let is_truth = value.is_instance_of::<PyBool>() || value.is_instance(&numpy_bool)?;
        if is_text || is_truth || value.is_none() {
            let value = value.repr()?;
            return Err(input_error(format!(
                "{argument_name}: {value} is not a number"
            )));
        }
    }
    Ok(())
}
