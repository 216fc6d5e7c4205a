//! What of a robot is not checked, as texts and warnings of Python.

use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use rigid_ccd_robot::CheckSummary;
use std::ffi::CString;

/// Returns the remarks of a summary as texts.
pub(crate) fn remark_texts(summary: &CheckSummary) -> Vec<String> {
    summary.remarks().iter().map(ToString::to_string).collect()
}

/// Returns the warnings of a summary for a `repr`; empty if there are none.
pub(crate) fn warning_text(summary: &CheckSummary) -> String {
    let warnings = summary.warnings();
    let texts = warnings.iter().map(|warning| format!("; {warning}"));
    texts.collect()
}

/// Warns the Python program if most of a robot is not checked.
pub(crate) fn warn_of_unchecked(py: Python<'_>, summary: &CheckSummary) -> PyResult<()> {
    for warning in summary.warnings() {
        let text = CString::new(warning.to_string())?;
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)?;
    }
    Ok(())
}
