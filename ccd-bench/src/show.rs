//! Presents measurements as tables, charts and a page.

pub mod chart;
pub mod comparable;
pub mod page;
pub mod presentation;
pub mod tables;
pub mod views;

use rigid_ccd_cli::OutputError;
use std::path::Path;

/// Writes a text into a file, or returns an error that names the file.
pub(crate) fn write_text_file(path: &Path, text: &str) -> Result<(), OutputError> {
    ccd_file::write(path, |out| out.write_all(text.as_bytes())).map_err(|source| OutputError {
        file_or_stream: path.display().to_string(),
        source,
    })
}
