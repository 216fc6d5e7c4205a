//! Errors of storing and loading bodies.

use crate::messages::{FileError, LFS_ADVICE};
use std::fmt;
use std::io;

/// The error of loading or storing a body: the file, and the fault.
pub type StoreError = FileError<StoreFault>;

/// The reason why a body cannot be stored or loaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StoreFault {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// The writer, or the file system, failed while the body was written.
    #[error("cannot be written: {0}")]
    Unwritable(#[source] io::Error),
    /// The file does not begin with the magic bytes of a stored body.
    #[error("holds no stored body; give a mesh, or {PREPARE_ADVICE}")]
    NotStoredBody,
    /// The file is a Git LFS pointer, whose content was not fetched.
    #[error("{LFS_ADVICE}")]
    LfsPointer,
    /// The file has a version of the format that this build does not read.
    #[error(
        "is of version {version} of the format, and version {} is what is read; {PREPARE_ADVICE}",
        FORMAT_VERSION
    )]
    UnsupportedVersion {
        /// The version of the format that the file states.
        version: u32,
    },
    /// The file ends before the length that it announces.
    #[error("is cut short; copy it again, or {PREPARE_ADVICE}")]
    Truncated,
    /// The stored checksum is not that of the file's bytes: the file is damaged.
    #[error(
        "is damaged: its checksum is not that of its bytes; copy it again, or {PREPARE_ADVICE}"
    )]
    ChecksumMismatch,
    /// The checksum matches, but the content is not a valid body.
    #[error("holds no valid body: {problem}; {PREPARE_ADVICE}")]
    InvalidContent {
        /// The description of the part that is not valid.
        problem: String,
    },
}

const PREPARE_ADVICE: &str = "prepare it again from its mesh: ccd decompose MESH --out FILE.ccd";

/// The version of the format that is written and read. Files of older versions are prepared again from their meshes,
/// instead of a second reader.
pub(super) const FORMAT_VERSION: u32 = 3;

impl StoreFault {
    pub(super) fn invalid_content(problem: &dyn fmt::Display) -> Self {
        StoreFault::InvalidContent {
            problem: problem.to_string(),
        }
    }
}
