//! Evidence: files with an answer about a path and the question, which `ccd replay` checks.

use crate::arguments::{reference, text};
use crate::cell::{RccdCell, joint_count};
use crate::path::RccdPath;
use crate::path_answer::RccdPathAnswer;
use crate::settings::RccdSettings;
use crate::solver::read_settings;
use crate::status::{Failure, RccdStatus, status_of};
use rigid_ccd_robot::evidence::Evidence;
use std::ffi::c_char;

/// Writes an answer of `rccd_cell_first_contact` and its question to a JSON file. The file has the path, the settings,
/// digests of all bodies of the cell, and the answer. `ccd replay` repeats the question without the deadline, and
/// reports whether the answer holds. The cell must be unchanged since the solver was made. If `settings` is null, the
/// defaults are written.
///
/// # Safety
/// `cell` is null or a handle; `settings` is null or points to settings, whose flag is null or a handle; `path` is as
/// for `rccd_cell_first_contact`; `answer` is null or points to an answer to it, whose solver is not freed; `file` is
/// null or a text that ends with a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_evidence_write(
    cell: *const RccdCell,
    settings: *const RccdSettings,
    path: *const RccdPath,
    answer: *const RccdPathAnswer,
    file: *const c_char,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let (cell, settings, file) = unsafe {
            (
                reference("cell", cell)?,
                read_settings(settings)?,
                text("file", file)?,
            )
        };
        // SAFETY: the contract of this function.
        let (path, answer) = unsafe {
            (
                RccdPath::record(path, joint_count(&cell.cell))?,
                RccdPathAnswer::record(answer)?,
            )
        };
        let evidence =
            Evidence::new(&cell.cell, &settings, path, answer).map_err(Failure::input)?;
        let json = evidence.to_json().map_err(Failure::input)?;
        ccd_file::write(file, |out| out.write_all(json.as_bytes()))
            .map_err(|error| Failure::input(format!("{file}: {error}")))
    })
}
