//! What can be wrong with a stored body.

use crate::messages::{LFS_ADVICE, Prefix};
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a stored body cannot be read, or a body not be stored.
#[derive(Debug, thiserror::Error)]
#[error("{}{fault}", Prefix(.file))]
pub struct StoreError {
    /// The file, where there is one.
    pub file: Option<PathBuf>,
    /// What is wrong with it.
    pub fault: StoreFault,
}

/// What is wrong with a stored body.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StoreFault {
    /// The operating system would not give the bytes.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// The operating system would not take the bytes.
    #[error("cannot be written: {0}")]
    Unwritable(#[source] io::Error),
    /// It does not begin as a stored body does.
    #[error("holds no stored body; give a mesh, or {PREPARE}")]
    Foreign,
    /// Git stands for it with a few lines.
    #[error("{LFS_ADVICE}")]
    LfsPointer,
    /// Another version of the program wrote it.
    #[error(
        "is of version {version} of the format, and version {} is what is read; {PREPARE}",
        VERSION
    )]
    OtherVersion {
        /// The version it says.
        version: u32,
    },
    /// It ends before all it announces is there.
    #[error("is cut short; copy it again, or {PREPARE}")]
    Truncated,
    /// Its bytes are not those that were written.
    #[error("is damaged: its checksum is not that of its bytes; copy it again, or {PREPARE}")]
    Damaged,
    /// Its bytes are whole, but say nothing that is a body.
    #[error("holds no valid body: {problem}; {PREPARE}")]
    Invalid {
        /// What is not valid.
        problem: String,
    },
}

const PREPARE: &str = "prepare it again from its mesh: ccd decompose MESH --out FILE.ccd";

/// The version that is written, and the only one that is read: what a body is prepared from is still
/// there, so that an older file is not worth a second reader.
pub(super) const VERSION: u32 = 2;

impl StoreFault {
    pub(super) fn invalid(problem: &dyn fmt::Display) -> Self {
        StoreFault::Invalid {
            problem: problem.to_string(),
        }
    }

    pub(super) fn in_file(self, file: &Path) -> StoreError {
        StoreError {
            file: Some(file.into()),
            fault: self,
        }
    }
}

impl From<StoreFault> for StoreError {
    fn from(fault: StoreFault) -> Self {
        StoreError { file: None, fault }
    }
}
