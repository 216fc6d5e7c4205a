//! Texts that the error messages about mesh files and about stored bodies have in common.

use std::fmt;
use std::path::PathBuf;

/// A fault of a file, with the path of the file.
#[derive(Debug, thiserror::Error)]
#[error("{}{fault}", path_prefix(.file.as_ref()))]
pub struct FileError<F: fmt::Display> {
    /// The path of the file; `None` for content from a reader or from memory.
    pub file: Option<PathBuf>,
    /// What is wrong with the file or its content.
    pub fault: F,
}

impl<F: fmt::Display> FileError<F> {
    pub(crate) fn new(file: impl Into<PathBuf>, fault: F) -> Self {
        let file = Some(file.into());
        FileError { file, fault }
    }
}

impl<F: fmt::Display> From<F> for FileError<F> {
    fn from(fault: F) -> Self {
        FileError { file: None, fault }
    }
}

fn path_prefix(file: Option<&PathBuf>) -> String {
    file.map_or_else(String::new, |file| format!("{}: ", file.display()))
}

/// The error message for a file that is a page of HTML instead of its content.
pub const HTML_ADVICE: &str = "is a page of HTML, whatever its name says; a server sends one for a file that it does not have";

/// Returns whether bytes begin like a page of HTML.
pub fn is_html(bytes: &[u8]) -> bool {
    let text = bytes.trim_ascii_start();
    let begins_with = |tag: &[u8]| {
        text.get(..tag.len())
            .is_some_and(|own| own.eq_ignore_ascii_case(tag))
    };
    begins_with(b"<!doctype html") || begins_with(b"<html")
}

/// The first bytes of a Git LFS pointer.
const LFS_POINTER_PREFIX: &[u8] = b"version https://git-lfs";

/// The error message for a file that is a Git LFS pointer instead of its content.
pub(crate) const LFS_ADVICE: &str = "is a Git LFS pointer, a few lines that stand for the file; run `git \
                                     lfs pull` to fetch the file itself";

/// Returns whether bytes begin like a Git LFS pointer.
pub(crate) fn is_lfs_pointer(bytes: &[u8]) -> bool {
    bytes.starts_with(LFS_POINTER_PREFIX)
}
