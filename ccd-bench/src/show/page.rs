//! What all pages share: the template, the style, the library that draws.

use super::chart::ChartError;
use plotly::Plot;
use std::io;
use std::path::{Path, PathBuf};

pub(super) use ccd_view::{escape, filled, json};

/// The style of all pages.
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

/// Returns the library that draws, as a script. Its other script renders formulas, and no page has any.
pub(super) fn plotly() -> String {
    const END: &str = "</script>";
    let scripts = Plot::offline_js_sources();
    let first = match scripts.split_once(END) {
        Some((first, _)) => format!("{first}{END}"),
        None => scripts,
    };
    format!("{}{first}", include_str!("page/canvas.html"))
}
