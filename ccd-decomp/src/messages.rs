//! Texts that messages about files of meshes and of bodies share.

use std::fmt;
use std::path::PathBuf;

/// Formats the path of a file before a fault, if there is a file.
pub(crate) struct Prefix<'a>(pub(crate) &'a Option<PathBuf>);

impl fmt::Display for Prefix<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(file) => write!(f, "{}: ", file.display()),
            None => Ok(()),
        }
    }
}

/// The first bytes of a Git LFS pointer.
const LFS_BEGINNING: &[u8] = b"version https://git-lfs";

/// The error message for a Git LFS pointer.
pub(crate) const LFS_ADVICE: &str = "is a Git LFS pointer, a few lines that stand for the file; run `git \
                                     lfs pull` to fetch the file itself";

/// Returns whether bytes begin like a Git LFS pointer.
pub(crate) fn is_lfs_pointer(bytes: &[u8]) -> bool {
    bytes.starts_with(LFS_BEGINNING)
}
