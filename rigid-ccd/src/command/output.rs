//! Outputs of a run: streams, and files that this process reserves and first writes under a temporary name.

use ccd_file::{Claim, Destination};
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
    pub(super) fn for_path(path: &Path, source: io::Error) -> Self {
        let place = output_name(path);
        OutputError {
            file_or_stream: place,
            source,
        }
    }

    pub(super) fn for_standard_output(source: io::Error) -> Self {
        OutputError::for_path(Path::new("-"), source)
    }
}

/// The file extension of a query's journal, which is next to the query's table of results.
pub(super) const JOURNAL_EXTENSION: &str = ".resume";

/// A destination that is checked and reserved before anything is written to it.
pub(super) enum Output {
    /// A file, reserved so that no other process writes it, with its path as the user gave it. An older file of this
    /// name is kept until the new one is complete.
    File(Claim, PathBuf),
    /// Standard output, a pipe, a terminal or a device.
    Stream(PathBuf),
}

impl Output {
    /// Reserves an output before the work starts, so that an output that cannot be written fails at once.
    pub(super) fn claim(path: &Path) -> Result<Self, OutputError> {
        let claim = || {
            if is_standard_output(path) {
                return Ok(Output::Stream(path.to_owned()));
            }
            Ok(match Destination::resolve(path)? {
                Destination::File(target) => Output::File(Claim::new(target)?, path.to_owned()),
                Destination::Stream => Output::Stream(path.to_owned()),
            })
        };
        claim().map_err(|source| OutputError::for_path(path, source))
    }

    /// Reserves an output for a table other than a query's results; refuses to overwrite an interrupted query.
    pub(super) fn claim_table(path: &Path) -> Result<Self, OutputError> {
        let output = Output::claim(path)?;
        match &output {
            Output::File(claim, _)
                if claim.left_length() > 0 && claim.sibling(JOURNAL_EXTENSION).exists() =>
            {
                let problem = format!(
                    "{} has rows of an interrupted query; continue that with --resume, or delete the file",
                    claim.partial_path().display()
                );
                let source = io::Error::new(io::ErrorKind::ResourceBusy, problem);
                Err(OutputError::for_path(path, source))
            }
            _ => Ok(output),
        }
    }

    /// Returns the name that messages give to the output.
    pub(super) fn name(&self) -> String {
        match self {
            Output::File(_, path) | Output::Stream(path) => output_name(path),
        }
    }

    pub(super) fn is_stream(&self) -> bool {
        matches!(self, Output::Stream(_))
    }

    /// Writes the whole output with one call of `fill`.
    pub(super) fn write(
        self,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        let place = self.name();
        let written = match self {
            Output::File(claim, _) => claim.write(fill),
            Output::Stream(path) if is_standard_output(&path) => fill(&mut io::stdout().lock()),
            Output::Stream(path) => ccd_file::write(path, fill),
        };
        written.map_err(|source| OutputError {
            file_or_stream: place,
            source,
        })
    }
}

/// Returns whether a path is `-` or `/dev/stdout`, which stand for standard output. A file to which standard output is
/// redirected is not replaced.
pub(super) fn is_standard_output(path: &Path) -> bool {
    is_dash(path) || path == Path::new("/dev/stdout")
}

/// Returns whether a path is `-`, which stands for standard input or output.
pub(super) fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn output_name(path: &Path) -> String {
    if is_standard_output(path) {
        "standard output".to_owned()
    } else {
        path.display().to_string()
    }
}
