//! Pages of rows: what `ccd view` shows.

use crate::errors::input as refuse;
use crate::table::answering::{Asked, each};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use rigid_ccd::picture::{self, Claim, PageError, Pages, PagesError};
use rigid_ccd::table::motions::TableError;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use crate::table::Reader;

/// A page cannot be made.
pub(crate) enum Fault {
    Table(TableError),
    Folder(std::io::Error),
    Page(PagesError),
}

/// Writes a page for each of some rows of a table into a folder; returns their paths, in the order of the rows.
pub(crate) fn write(
    asked: Asked<'_>,
    reader: Reader,
    rows: &HashSet<usize>,
    folder: &Path,
    stop: &AtomicBool,
) -> Result<Vec<PathBuf>, Fault> {
    let shown = picture::Asked {
        claim: Claim::First,
        margin: asked.config.margin,
        clearance: None,
    };
    let title = "Body A and body B".to_owned();
    let mut pages = Pages::create(asked.bodies, shown, title, folder).map_err(Fault::Folder)?;
    let mut paths = Vec::new();
    let mut fault = None;
    each(asked, reader, rows, stop, |course, row| {
        match pages.write(course, row) {
            Ok(path) => paths.push(path),
            Err(error) => {
                fault.get_or_insert(error);
            }
        }
    })
    .map_err(Fault::Table)?;
    match fault {
        Some(fault) => Err(Fault::Page(fault)),
        None => Ok(paths),
    }
}

impl From<Fault> for PyErr {
    fn from(fault: Fault) -> Self {
        match fault {
            Fault::Table(error) => refuse(error),
            Fault::Folder(error) => error.into(),
            Fault::Page(PagesError::Page(PageError::Write { path, source })) => {
                PyOSError::new_err(format!("{}: {source}", path.display()))
            }
            Fault::Page(error) => refuse(error),
        }
    }
}
