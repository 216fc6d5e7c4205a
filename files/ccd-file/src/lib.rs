//! Atomic writes of output files, by one process at a time, and bounded reads of input files.
//!
//! | to … | see |
//! |---|---|
//! | write a file in one go | [`write()`] |
//! | write a file over a long time, as its only writer | [`Claim`] |
//! | distinguish files from pipes and devices | [`Destination`] |
//! | read a whole file, but no device | [`read()`], [`read_to_string`], [`open`] |
//!
//! # Guarantee
//! A file has its final name only when it is complete and on the disk. Until then an older file of that name is
//! unchanged: an error, a full disk or a killed process loses nothing. Later calls of [`write()`] remove what a killed
//! process left beside it. A new file has the permissions of the file that it replaces. Links are followed: their
//! targets are replaced.

mod claim;
mod destination;
mod read;
mod temp_file;

pub use claim::{Claim, PARTIAL_EXTENSION};
pub use destination::{Destination, check_parent_folder, folder_to_open, resolve_links};
pub use read::{MAX_FILE_BYTES, MAX_PIPE_BYTES, open, read, read_to_string};

use std::io::{self, Write};
use std::path::Path;
use temp_file::{TempFile, write_buffered};

/// Writes a file atomically: to a temporary file, which is then renamed.
///
/// Threads and processes may write the same file at the same time: the last complete one stays. Pipes and devices are
/// written directly.
///
/// # Errors
/// Errors of `fill` and of the operating system. An older file is then unchanged.
///
/// ```
/// let file = std::env::temp_dir().join(format!("ccd-file-{}", std::process::id()));
/// ccd_file::write(&file, |out| out.write_all(b"whole"))?;
/// let full = ccd_file::write(&file, |_| Err(std::io::ErrorKind::StorageFull.into()));
/// assert!(full.is_err());
/// assert_eq!(std::fs::read(&file)?, b"whole");
/// # std::fs::remove_file(&file)?;
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn write(
    path: impl AsRef<Path>,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let path = path.as_ref();
    match Destination::resolve(path)? {
        Destination::File(target) => {
            let mut temporary = TempFile::new(target)?;
            write_buffered(&mut temporary.file, fill)?;
            temporary.place()
        }
        Destination::Stream => write_buffered(destination::open_stream(path)?, fill),
    }
}

#[cfg(test)]
mod tests;
