//! The template and the style of a page.

use super::chart::ChartError;
use std::io;
use std::path::{Path, PathBuf};

pub(super) use ccd_view::{escape, filled};

/// The style of a page.
pub(super) const STYLE: &str = include_str!("page/style.css");

/// A page cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// A chart cannot be drawn.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The data for the page's scripts cannot be serialised.
    #[error("the page's data: {0}")]
    Data(#[from] serde_json::Error),
    /// The file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
}

/// Writes a page into a file.
///
/// # Errors
/// [`PageError::Write`].
pub(super) fn write(path: &Path, html: &str) -> Result<(), PageError> {
    ccd_file::write(path, |out| out.write_all(html.as_bytes())).map_err(|source| PageError::Write {
        path: path.to_owned(),
        source,
    })
}
