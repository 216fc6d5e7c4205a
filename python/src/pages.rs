//! Writes pages for rows of a table, as `ccd view` writes them.

use crate::body::body_of;
use crate::errors::{file_error, input_error as refuse};
use crate::interruptible::run_interruptibly;
use crate::settings::{CONTACT_SETTINGS, read};
use crate::table::answering::{TableQuestion, answer_rows};
use crate::table::input::{self, Reader};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigid_ccd::batch::{Bodies, Question};
use rigid_ccd::picture::{self, Claim, PageError, Pages, PagesError};
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Writes a page for each of some rows of a table of motions, by their indices; called by `rigid_ccd.audit`.
#[pyfunction]
#[pyo3(signature = (a, b, motions, rows, folder, **settings))]
pub(crate) fn write_pages(
    py: Python<'_>,
    a: &Bound<'_, PyAny>,
    b: &Bound<'_, PyAny>,
    motions: &Bound<'_, PyAny>,
    rows: HashSet<usize>,
    folder: PathBuf,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<PathBuf>> {
    let settings = read(settings, CONTACT_SETTINGS)?;
    let asked = TableQuestion {
        bodies: Bodies {
            a: body_of(a, "a")?,
            b: body_of(b, "b")?,
        },
        question: Question::FirstContact,
        settings: &settings,
        threads: Some(1),
        has_micros: false,
    };
    let reader = input::open(motions)?;
    let work = |stop: &Arc<_>| write(asked, reader, &rows, &folder, stop);
    let (written, seen) = run_interruptibly(py, work, |_| Ok(()))?;
    seen?;
    written
}

/// Writes a page for each of some rows of a table into a folder; returns the pages' paths, in the order of the rows.
fn write(
    asked: TableQuestion<'_>,
    reader: Reader,
    rows: &HashSet<usize>,
    folder: &Path,
    stop: &Arc<AtomicBool>,
) -> PyResult<Vec<PathBuf>> {
    let shown = picture::Asked {
        claim: Claim::First,
        margin: asked.settings.margin,
        clearance: None,
    };
    let title = "Body A and body B".to_owned();
    let mut pages = Pages::create(asked.bodies, shown, title, folder)
        .map_err(|error| file_error(&error, folder))?;
    let mut paths = Vec::new();
    let mut fault = None;
    answer_rows(asked, reader, rows, stop, |course, row| {
        match pages.write(course, row) {
            Ok(path) => paths.push(path),
            Err(error) => {
                fault.get_or_insert(error);
            }
        }
    })
    .map_err(refuse)?;
    match fault {
        Some(PagesError::Page(PageError::Write { path, source })) => {
            Err(file_error(&source, &path))
        }
        Some(fault) => Err(refuse(fault)),
        None => Ok(paths),
    }
}
