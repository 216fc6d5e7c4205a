//! Reads numbers from arguments of Python. Refuses truth values, which Python treats as numbers.

use crate::errors::{input_error, wrong_type_error};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat};
use std::fmt::Display;
use std::ops::RangeInclusive;

/// Reads a whole number in a range. Errors name the argument.
pub(crate) fn whole_number<'py, T>(
    argument: &Bound<'py, PyAny>,
    argument_name: &str,
    range: RangeInclusive<T>,
) -> PyResult<T>
where
    T: for<'a> FromPyObject<'a, 'py, Error = PyErr> + PartialOrd + Display,
{
    let py = argument.py();
    refuse_truth(argument, argument_name)?;
    let whole = py.import("operator")?.call_method1("index", (argument,));
    let whole = whole.map_err(|error| {
        if error.is_instance_of::<PyTypeError>(py) {
            wrong_type_error(argument_name, "a whole number", argument)
        } else {
            error
        }
    })?;
    let number = whole
        .extract::<T>()
        .ok()
        .filter(|number| range.contains(number));
    number.ok_or_else(|| {
        let (least, most) = (range.start(), range.end());
        // Python refuses to format numbers with thousands of digits.
        let text = whole
            .str()
            .map_or_else(|_| "the number".to_owned(), |text| text.to_string());
        input_error(format!(
            "{argument_name}: {text} is not from {least} to {most}"
        ))
    })
}

/// Refuses a truth value.
pub(crate) fn refuse_truth(argument: &Bound<'_, PyAny>, argument_name: &str) -> PyResult<()> {
    if is_truth(argument)? {
        Err(wrong_type_error(argument_name, "a number", argument))
    } else {
        Ok(())
    }
}

/// Returns whether an object is a truth value of Python or NumPy.
fn is_truth(argument: &Bound<'_, PyAny>) -> PyResult<bool> {
    if argument.is_instance_of::<PyFloat>() {
        return Ok(false);
    }
    let numpy = argument.py().import("numpy")?;
    Ok(argument.is_instance_of::<PyBool>() || argument.is_instance(&numpy.getattr("bool_")?)?)
}

/// Reads a number. pyo3 adds the name of the argument to an exception for a wrong type.
pub(crate) fn read_number(argument: &Bound<'_, PyAny>) -> PyResult<f64> {
    if is_truth(argument)? {
        Err(PyTypeError::new_err("must be a number, not bool"))
    } else {
        argument.extract()
    }
}

/// Reads a number, or None.
pub(crate) fn read_optional_number(argument: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
    if argument.is_none() {
        Ok(None)
    } else {
        read_number(argument).map(Some)
    }
}
