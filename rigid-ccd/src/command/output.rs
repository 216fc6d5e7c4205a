//! Outputs: streams, and files that are claimed by this process and written to a temporary file.

use ccd_file::{Claim, Destination};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// An output cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {place}: {source}")]
pub struct CannotWrite {
    /// The file or stream.
    pub place: String,
    /// The reason.
    pub source: io::Error,
}

impl CannotWrite {
    pub(super) fn at(path: &Path, source: io::Error) -> Self {
        let place = output_name(path);
        CannotWrite { place, source }
    }
}

/// The file extension of a query's journal, which lies beside its results.
pub(super) const RESUME: &str = ".resume";

/// An output before it is written.
pub(super) enum Output {
    /// A file, by the given path, claimed against other processes. An older file of its name is kept until it is
    /// complete.
    File(Claim, PathBuf),
    /// Standard output, a pipe, a terminal or a device.
    Stream(PathBuf),
}

impl Output {
    /// Claims an output before the work starts, so that an output that cannot be written fails at once.
    pub(super) fn claim(path: &Path) -> Result<Self, CannotWrite> {
        let claim = || {
            if is_standard_output(path) {
                return Ok(Output::Stream(path.to_owned()));
            }
            Ok(match Destination::resolve(path)? {
                Destination::File(target) => Output::File(Claim::new(target)?, path.to_owned()),
                Destination::Stream => Output::Stream(path.to_owned()),
            })
        };
        claim().map_err(|source| CannotWrite::at(path, source))
    }

    /// Claims an output for a table other than a query's results; refuses to overwrite an interrupted query.
    pub(super) fn claim_table(path: &Path) -> Result<Self, CannotWrite> {
        let output = Output::claim(path)?;
        match &output {
            Output::File(claim, _) if claim.left() > 0 && claim.sibling(RESUME).exists() => {
                let problem = format!(
                    "{} has rows of an interrupted query; continue that with --resume, or delete the file",
                    claim.partial().display()
                );
                let source = io::Error::new(io::ErrorKind::ResourceBusy, problem);
                Err(CannotWrite::at(path, source))
            }
            _ => Ok(output),
        }
    }

    /// Returns the name for messages.
    pub(super) fn name(&self) -> String {
        match self {
            Output::File(_, path) | Output::Stream(path) => output_name(path),
        }
    }

    pub(super) fn is_stream(&self) -> bool {
        matches!(self, Output::Stream(_))
    }

    /// Writes the whole output at once.
    pub(super) fn write(
        self,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), CannotWrite> {
        let place = self.name();
        let written = match self {
            Output::File(claim, _) => claim.write(fill),
            Output::Stream(path) if is_standard_output(&path) => fill(&mut io::stdout().lock()),
            Output::Stream(path) => ccd_file::write(path, fill),
        };
        written.map_err(|source| CannotWrite { place, source })
    }
}

/// Returns whether a path stands for standard output, even one redirected to a file: such a file is not replaced.
pub(super) fn is_standard_output(path: &Path) -> bool {
    is_standard(path) || path == Path::new("/dev/stdout")
}

/// Returns whether a path stands for a standard stream.
pub(super) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn output_name(path: &Path) -> String {
    if is_standard_output(path) {
        "standard output".to_owned()
    } else {
        path.display().to_string()
    }
}
