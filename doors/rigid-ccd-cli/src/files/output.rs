//! Outputs of a run: streams, and files that this process reserves and first writes under a temporary name.

use crate::console::printable::PrintableText;
use crate::console::standard_output;
use ccd_file::{Claim, Destination};
use std::fmt::Display;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The error of an output that cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {file_or_stream}: {source}")]
pub struct OutputError {
    /// The path of the file, or the name of the stream.
    pub file_or_stream: String,
    /// The error of the operating system.
    pub source: io::Error,
}

impl OutputError {
    pub(crate) fn error_for_path(path: &Path, source: io::Error) -> Self {
        OutputError {
            file_or_stream: output_name(path),
            source,
        }
    }

    pub(crate) fn standard_output_error(source: io::Error) -> Self {
        OutputError::error_for_path(Path::new("-"), source)
    }
}

/// The file extension of a query's journal, which is next to the query's table of results.
pub(crate) const JOURNAL_EXTENSION: &str = ".resume";

/// A destination that is checked and reserved before anything is written to it.
pub(crate) struct Output {
    /// The path as the user gave it.
    path: PathBuf,
    /// The file, reserved so that no other process writes it. An older file of this name is kept until the new one is
    /// complete. `None` for standard output, a pipe, a terminal or a device.
    pub(crate) reserved_file: Option<Claim>,
}

impl Output {
    /// Reserves an output before the work starts, so that an output that cannot be written fails at once.
    pub(crate) fn claim(path: &Path) -> Result<Self, OutputError> {
        let claim = match Destination::resolve(path) {
            _ if is_standard_output(path) => Ok(None),
            Ok(Destination::File(target)) => Claim::new(target).map(Some),
            Ok(Destination::Stream) => Ok(None),
            Err(error) => Err(error),
        };
        Ok(Output {
            path: path.to_owned(),
            reserved_file: claim.map_err(|source| OutputError::error_for_path(path, source))?,
        })
    }

    /// Reserves an output for a table other than a query's results; refuses to overwrite an interrupted query.
    pub(crate) fn claim_table(path: &Path) -> Result<Self, OutputError> {
        let output = Output::claim(path)?;
        match &output.reserved_file {
            Some(claim)
                if claim.initial_length() > 0 && claim.sibling(JOURNAL_EXTENSION).exists() =>
            {
                let problem = format!(
                    "{} has rows of an interrupted query; continue that with --resume, or delete the file",
                    claim.partial_path().display()
                );
                Err(output.error(io::Error::new(io::ErrorKind::ResourceBusy, problem)))
            }
            _ => Ok(output),
        }
    }

    /// Returns the name that messages give to the output.
    pub(crate) fn name(&self) -> String {
        output_name(&self.path)
    }

    pub(crate) fn is_stream(&self) -> bool {
        self.reserved_file.is_none()
    }

    pub(crate) fn error(&self, source: io::Error) -> OutputError {
        OutputError::error_for_path(&self.path, source)
    }

    /// Opens the output for writing; a file is written from its current position.
    pub(crate) fn open(&mut self) -> io::Result<Box<dyn Write>> {
        Ok(match &mut self.reserved_file {
            Some(claim) => Box::new(claim.file().try_clone()?),
            None if is_standard_output(&self.path) => Box::new(standard_output::lock()?),
            None => Box::new(File::options().append(true).open(&self.path)?),
        })
    }

    /// Writes the whole output with one call of `fill`.
    pub(crate) fn write(
        self,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        let written = match self.reserved_file {
            Some(claim) => claim.write(fill),
            None if is_standard_output(&self.path) => {
                standard_output::lock().and_then(|mut stream| fill(&mut stream))
            }
            None => ccd_file::write(&self.path, fill),
        };
        written.map_err(|source| OutputError::error_for_path(&self.path, source))
    }
}

/// Writes a line to standard output, with control characters escaped.
pub(crate) fn print_line(line: &str) -> Result<(), OutputError> {
    print(PrintableText(line))
}

/// Writes a text and an end of line to standard output.
pub(crate) fn print(text: impl Display) -> Result<(), OutputError> {
    let printed = standard_output::lock().and_then(|mut stream| writeln!(stream, "{text}"));
    printed.map_err(OutputError::standard_output_error)
}

/// Returns whether a path is `-` or `/dev/stdout`, which stand for standard output. A file to which standard output is
/// redirected is not replaced.
pub(crate) fn is_standard_output(path: &Path) -> bool {
    is_dash(path) || path == Path::new("/dev/stdout")
}

/// Returns whether a path is `-`, which stands for standard input or output.
pub(crate) fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn output_name(path: &Path) -> String {
    if is_standard_output(path) {
        "standard output".to_owned()
    } else {
        path.display().to_string()
    }
}
