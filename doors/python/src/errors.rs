//! The Python exceptions, and conversions to them.

use pyo3::exceptions::{
    PyException, PyKeyboardInterrupt, PyOSError, PyRuntimeError, PyTypeError, PyUserWarning,
};
use pyo3::prelude::*;
use rigid_ccd::Remark;
use rigid_ccd::answer::{self, Limit};
use std::any::Any;
use std::ffi::CString;
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

pyo3::import_exception!(rigid_ccd._errors, InputError);
pyo3::import_exception!(rigid_ccd._errors, UnresolvedError);
pyo3::import_exception!(rigid_ccd._errors, InterruptError);

/// Runs code of libraries that panics on some tables or arrays, and converts a panic to an `InputError`.
///
/// Python could not catch a panic with `except Exception`.
pub(crate) fn run_catching_panics<T>(
    context: &str,
    work: impl FnOnce() -> PyResult<T>,
) -> PyResult<T> {
    let done = catch_unwind(AssertUnwindSafe(work));
    done.unwrap_or_else(|panic| {
        Err(input_error(format!(
            "{context}: {}",
            panic_message(panic.as_ref())
        )))
    })
}

/// Converts a panic to a `RuntimeError` that asks the user to report it, because no known input causes it.
pub(crate) fn panic_error(panic: &(dyn Any + Send)) -> PyErr {
    PyRuntimeError::new_err(format!(
        "a defect of rigid_ccd, please report it: {}",
        panic_message(panic)
    ))
}

/// Returns the text of a panic's message.
fn panic_message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("it is not supported")
}

/// Converts an error of the library to an `InputError`.
pub(crate) fn input_error(error: impl Display) -> PyErr {
    InputError::new_err(error.to_string())
}

/// Converts an error of a table to an `InputError`, or to a `KeyboardInterrupt` if Ctrl-C caused it.
///
/// A stream passes only the text of an exception, so Ctrl-C is recognised by the text.
pub(crate) fn input_error_or_interrupt(error: impl Display) -> PyErr {
    let text = error.to_string();
    let last = text.trim_end().lines().next_back().unwrap_or_default();
    let raised = last.rsplit("Python exception: ").next().unwrap_or_default();
    if text.contains("Python exception: ") && raised.starts_with("KeyboardInterrupt") {
        PyKeyboardInterrupt::new_err(raised.to_owned())
    } else {
        input_error(text)
    }
}

/// Converts an exception to an `InputError` with the exception as its cause. Returns an exception that ends the program,
/// such as `KeyboardInterrupt`, unchanged.
pub(crate) fn input_error_from(py: Python<'_>, argument_name: &str, cause: PyErr) -> PyErr {
    if !cause.is_instance_of::<PyException>(py) {
        return cause;
    }
    let error = InputError::new_err(format!("{argument_name}: {}", cause.value(py)));
    error.set_cause(py, Some(cause));
    error
}

/// Converts an error of a file to an `OSError` of the same kind, with the error number and the path.
pub(crate) fn file_error(error: &std::io::Error, path: &std::path::Path) -> PyErr {
    match error.raw_os_error() {
        // `OSError` chooses the subclass by the error number.
        Some(number) => {
            let text = error.to_string();
            let text = text
                .split(" (os error")
                .next()
                .unwrap_or_default()
                .to_owned();
            PyOSError::new_err((number, text, path.display().to_string()))
        }
        None => PyOSError::new_err(format!("{}: {error}", path.display())),
    }
}

/// Makes an `UnresolvedError` for a question about contacts, with the time `safe_until` before which no contact happens.
pub(crate) fn unresolved_error(py: Python<'_>, known: &answer::Unresolved) -> PyErr {
    let (advice, safe_until) = (known.limit.advice(), known.safe_until);
    let error =
        UnresolvedError::new_err(format!("{advice}; no contact happens before {safe_until}"));
    with_attribute(py, error, "safe_until", safe_until)
}

/// Makes an `UnresolvedError` for a question about contacts on a path, with the time `safe_until` until which the path is
/// free.
pub(crate) fn path_limit_error(limit: Limit, safe_until: f64) -> PyErr {
    let text = format!("a limit was reached ({limit}); free until {safe_until}");
    let error = UnresolvedError::new_err(text);
    Python::attach(|py| with_attribute(py, error, "safe_until", safe_until))
}

/// Makes an `UnresolvedError` for a question about a distance, with the bounds `lower` and `upper`.
pub(crate) fn unresolved_distance_error(py: Python<'_>, known: &answer::Unresolved) -> PyErr {
    let (advice, lower, upper) = (known.limit.advice(), known.lower, known.upper);
    let error =
        UnresolvedError::new_err(format!("{advice}; the distance is from {lower} to {upper}"));
    with_bounds(py, error, [lower, upper])
}

/// Makes the exception for work that ended because of Ctrl-C, or of an exception in a signal handler or a callback. Its
/// attribute `results` has the results so far.
pub(crate) fn interruption_error<'py>(
    py: Python<'py>,
    cause: PyErr,
    results: impl IntoPyObject<'py>,
) -> PyErr {
    let text = "interrupted; `results` has the answers so far";
    with_attribute(
        py,
        interruption(py, cause, text.to_owned()),
        "results",
        results,
    )
}

/// Makes the exception for an interrupted question about contacts. Nothing touches before `safe_until`, if it is known.
pub(crate) fn time_interruption(py: Python<'_>, cause: PyErr, safe_until: Option<f64>) -> PyErr {
    let known = safe_until.map_or_else(String::new, |time| {
        format!("; no contact happens before {time}")
    });
    let error = interruption(py, cause, format!("interrupted{known}"));
    with_attribute(py, error, "safe_until", safe_until)
}

/// Makes the exception for an interrupted question about a distance.
pub(crate) fn bounds_interruption(py: Python<'_>, cause: PyErr, [lower, upper]: [f64; 2]) -> PyErr {
    let text = format!("interrupted; the distance is from {lower} to {upper}");
    with_bounds(py, interruption(py, cause, text), [lower, upper])
}

fn with_bounds(py: Python<'_>, error: PyErr, [lower, upper]: [f64; 2]) -> PyErr {
    let error = with_attribute(py, error, "lower", lower);
    with_attribute(py, error, "upper", upper)
}

/// Converts the `KeyboardInterrupt` of a Ctrl-C to an `InterruptError`. Returns an exception of a signal handler or a
/// callback unchanged.
fn interruption(py: Python<'_>, cause: PyErr, text: String) -> PyErr {
    if !cause.get_type(py).is(py.get_type::<PyKeyboardInterrupt>()) {
        return cause;
    }
    let error = InterruptError::new_err(text);
    error.set_cause(py, Some(cause));
    error
}

/// Warns the Python program of input that is valid, but probably a mistake. `calls_up` is the number of calls between this
/// function and the line of Python that the warning names. Python shows each text from one line only once, so texts should
/// not contain numbers.
pub(crate) fn warn(
    py: Python<'_>,
    remarks: impl IntoIterator<Item = Remark>,
    calls_up: i32,
) -> PyResult<()> {
    for remark in remarks {
        let text = CString::new(remark.general_text())?;
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, calls_up)?;
    }
    Ok(())
}

/// Makes a `TypeError` that names the needed type and the type of the argument.
pub(crate) fn wrong_type_error(
    argument_name: &str,
    needed: &str,
    argument: &Bound<'_, PyAny>,
) -> PyErr {
    let class = argument.get_type();
    let name = class
        .fully_qualified_name()
        .map_or_else(|_| "?".to_owned(), |name| name.to_string());
    PyTypeError::new_err(format!("{argument_name}: {needed} is needed, not {name}"))
}

/// Sets an attribute of a Python exception, and returns the exception.
pub(crate) fn with_attribute<'py>(
    py: Python<'py>,
    error: PyErr,
    name: &str,
    value: impl IntoPyObject<'py>,
) -> PyErr {
    // Ignores a failure: only an exception whose class forbids the attribute fails.
    let _ = error.value(py).setattr(name, value);
    error
}
