//! Output files that are written whole, by one process at a time.
//!
//! | to … | see |
//! |---|---|
//! | write a file in one go | [`write()`] |
//! | write a file for long, alone | [`Claim`] |
//! | tell files from pipes and devices | [`Destination`] |
//!
//! # Guarantee
//! A file has its final name only when it is complete and on the disk. Until then an older file of that name is as it
//! was: an error, a full disk or a killed process loses nothing. A new file has the permissions of the one that it
//! replaces. Links are followed: what they lead to is replaced, not they themselves.

mod beside;
mod claim;
mod destination;

pub use claim::{Claim, PARTIAL};
pub use destination::{Destination, check_folder, end_of_links};

use beside::{Beside, buffered};
use std::io::{self, Write};
use std::path::Path;

/// Writes a file in one go: beside its name, and then in its place.
///
/// Threads and processes may write the same file at the same time: the last one that is complete stays. A pipe or a
/// device is written directly.
///
/// # Errors
/// What `fill` returns, and what the operating system refuses. The older file, if any, is as it was then.
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
    match Destination::of(path)? {
        Destination::File(target) => {
            let mut beside = Beside::new(target)?;
            buffered(&mut beside.file, fill)?;
            beside.place()
        }
        Destination::Stream => buffered(destination::open_stream(path)?, fill),
    }
}

#[cfg(test)]
mod tests;
