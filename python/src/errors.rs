//! The exceptions.

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::fmt::Display;

pyo3::create_exception!(
    rigid_ccd,
    InputError,
    PyValueError,
    "A number, a mesh or a motion that is out of range; the message names the element."
);
pyo3::create_exception!(
    rigid_ccd,
    Unresolved,
    PyRuntimeError,
    "A limit was reached first. Attribute `safe_until`: no contact happens before this time."
);

/// Turns an error of the library into an `InputError`.
pub(crate) fn input(error: impl Display) -> PyErr {
    InputError::new_err(error.to_string())
}

/// Turns an error of a query into an exception.
pub(crate) fn query(py: Python<'_>, error: rigid_ccd::Error) -> PyErr {
    match error {
        rigid_ccd::Error::Unresolved { safe_until, reason } => unresolved(py, safe_until, reason),
        other => input(other),
    }
}

/// Makes an `Unresolved`.
pub(crate) fn unresolved(py: Python<'_>, safe_until: f64, reason: impl Display) -> PyErr {
    let error = Unresolved::new_err(format!("{reason}; no contact happens before {safe_until}"));
    // An exception takes any attribute.
    let _ = error.value(py).setattr("safe_until", safe_until);
    error
}
