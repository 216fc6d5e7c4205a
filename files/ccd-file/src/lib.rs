//! Atomic writes of output files, by one process at a time, and reads of input files that end.
//!
//! | to … | see |
//! |---|---|
//! | write a file in one go | [`write()`] |
//! | write a file for long, alone | [`Claim`] |
//! | tell files from pipes and devices | [`Destination`] |
//! | read a whole file, and no device | [`read()`], [`read_to_string`], [`open`] |
//!
//! # Guarantee
//! A file has its final name only when it is complete and on the disk. Until then an older file of that name is
//! unchanged: an error, a full disk or a killed process loses nothing. What a killed process left beside it, [`write()`]
//! removes later. A new file has the permissions of the file that
//! it replaces. Links are followed: their targets are replaced.

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
