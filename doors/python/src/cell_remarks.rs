//! Remarks on robots, cells and questions about cells, as texts and warnings of Python.

use crate::path_array::{GivenPath, GivenPaths};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use rigid_ccd_robot::{Cell, CellRemark};
use std::ffi::CString;

/// Returns remarks as texts.
pub(crate) fn remark_texts(remarks: &[CellRemark]) -> Vec<String> {
    remarks.iter().map(ToString::to_string).collect()
}

/// Returns the warnings among remarks as a text for a `repr`. It is empty if there are none.
pub(crate) fn warning_text(remarks: &[CellRemark]) -> String {
    let warnings = remarks.iter().filter(|remark| remark.is_warning());
    warnings.map(|warning| format!("; {warning}")).collect()
}

/// Shows those remarks that are warnings as Python warnings. Warnings about input have no numbers, because Python shows
/// each text from one line of code only once.
pub(crate) fn warn_of(
    py: Python<'_>,
    remarks: impl IntoIterator<Item = CellRemark>,
) -> PyResult<()> {
    for remark in remarks.into_iter().filter(CellRemark::is_warning) {
        let text = match &remark {
            CellRemark::Input { item, remark } => format!("{item}: {}", remark.general_text()),
            other => other.to_string(),
        };
        let text = CString::new(text)?;
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)?;
    }
    Ok(())
}

/// The path or paths that a question is about.
pub(crate) enum AskedPaths<'a> {
    Path(&'a GivenPath),
    Paths(&'a GivenPaths),
}

/// Warns of a tolerance that is large compared with the bodies in the cell, and of positions that seem to be in
/// degrees.
pub(crate) fn warn_of_question(
    py: Python<'_>,
    cell: &Cell,
    paths: &AskedPaths<'_>,
    tolerance: f64,
) -> PyResult<()> {
    let tolerance_remark = cell.remark_on_tolerance(tolerance);
    let robot = cell.robot();
    let position_remark =
        match paths {
            AskedPaths::Path(path) => path
                .find_configuration(|configuration| robot.remark_on_configuration(configuration)),
            AskedPaths::Paths(paths) => paths
                .find_configuration(|configuration| robot.remark_on_configuration(configuration)),
        };
    warn_of(py, tolerance_remark.into_iter().chain(position_remark))
}
