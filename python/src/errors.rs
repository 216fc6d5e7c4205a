//! The exceptions.

use pyo3::exceptions::{
    PyException, PyKeyboardInterrupt, PyOSError, PyRuntimeError, PyTypeError, PyValueError,
};
use pyo3::prelude::*;
use rigid_ccd::Limit;
use std::fmt::Display;

pyo3::create_exception!(
    rigid_ccd,
    InputError,
    PyValueError,
    "A number, a mesh, a motion or a table that is out of range; the message names the element."
);
pyo3::create_exception!(
    rigid_ccd,
    Unresolved,
    PyRuntimeError,
    "A limit was reached first. Attribute `safe_until`: no contact happens before this time; or, of a distance, `lower` and `upper`: what is known of it."
);
pyo3::create_exception!(
    rigid_ccd,
    Interrupted,
    PyKeyboardInterrupt,
    "Ctrl-C ended a table. Attribute `results`: the rows answered by then, from the first on."
);

/// Turns an error of the library into an `InputError`.
pub(crate) fn input(error: impl Display) -> PyErr {
    InputError::new_err(error.to_string())
}

/// Turns an exception of somebody else into an `InputError`, with it as the cause. Those that are to end the program,
/// such as that of Ctrl-C, stay what they are.
pub(crate) fn caused(py: Python<'_>, what: &str, cause: PyErr) -> PyErr {
    if !cause.is_instance_of::<PyException>(py) {
        return cause;
    }
    let error = InputError::new_err(format!("{what}: {}", cause.value(py)));
    error.set_cause(py, Some(cause));
    error
}

/// Turns an error of a file into an `OSError` of its kind, with its number and the file.
pub(crate) fn of_file(error: &std::io::Error, path: &std::path::Path) -> PyErr {
    match error.raw_os_error() {
        // OSError chooses the class by the number.
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

/// Turns an error of a query into an exception.
pub(crate) fn query(py: Python<'_>, error: rigid_ccd::Error) -> PyErr {
    match error {
        rigid_ccd::Error::Unresolved { safe_until, reason } => unresolved(py, safe_until, reason),
        other => input(other),
    }
}

/// Makes an `Unresolved`.
pub(crate) fn unresolved(py: Python<'_>, safe_until: f64, reason: Limit) -> PyErr {
    let error = Unresolved::new_err(format!(
        "{}; no contact happens before {safe_until}",
        ended_by(reason)
    ));
    with_attribute(py, error, "safe_until", safe_until)
}

/// Makes an `Unresolved` of a distance with these bounds.
pub(crate) fn unresolved_distance(
    py: Python<'_>,
    [lower, upper]: [f64; 2],
    reason: Limit,
) -> PyErr {
    let reason = ended_by(reason);
    let error = Unresolved::new_err(format!("{reason}; the distance is from {lower} to {upper}"));
    let error = with_attribute(py, error, "lower", lower);
    with_attribute(py, error, "upper", upper)
}

/// Says what ended a query, and what to do.
fn ended_by(limit: Limit) -> String {
    match limit {
        Limit::Budget => "the budget is spent (pass a larger one)".to_owned(),
        Limit::Deadline => "the deadline has passed (pass a later one)".to_owned(),
        other => other.to_string(),
    }
}

/// Makes an `Interrupted` of Ctrl-C; other exceptions of a signal, or of a callback, stay what they are. Either has
/// what is done.
pub(crate) fn interrupted<'py>(
    py: Python<'py>,
    cause: PyErr,
    results: impl IntoPyObject<'py>,
) -> PyErr {
    let error = match cause.get_type(py).is(py.get_type::<PyKeyboardInterrupt>()) {
        true => {
            let error =
                Interrupted::new_err("interrupted; `results` has the rows answered by then");
            error.set_cause(py, Some(cause));
            error
        }
        false => cause,
    };
    with_attribute(py, error, "results", results)
}

/// Says that an object is of the wrong type.
pub(crate) fn wrong_type(what: &str, needed: &str, found: &Bound<'_, PyAny>) -> PyErr {
    let kind = found.get_type();
    let name = kind
        .fully_qualified_name()
        .map_or_else(|_| "?".to_owned(), |name| name.to_string());
    PyTypeError::new_err(format!("{what}: {needed} is needed, not {name}"))
}

/// Adds an attribute to an exception.
pub(crate) fn with_attribute<'py>(
    py: Python<'py>,
    error: PyErr,
    name: &str,
    value: impl IntoPyObject<'py>,
) -> PyErr {
    // An exception takes any attribute, unless its class forbids it.
    let _ = error.value(py).setattr(name, value);
    error
}
