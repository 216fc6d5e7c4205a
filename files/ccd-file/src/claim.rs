//! Files that only one process writes at a time.

use crate::temp_file::{TempFile, error_with_path, leads_to_file, sibling, write_buffered};
use std::fs::{File, TryLockError};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The extension that is appended to the name of a claimed file.
pub const PARTIAL_EXTENSION: &str = ".partial";

/// A file that only this process writes, under a temporary name in the folder of its target.
///
/// # Guarantee
/// If several processes claim a file, under any path, only one claim succeeds. The operating system releases a claim
/// when its process ends in any way. On a file system without locks all claims succeed.
///
/// A dropped claim removes its file, unless the file was not empty when claimed, or is [kept](Claim::keep_on_drop).
#[derive(Debug)]
pub struct Claim {
    /// The open file, which is locked as long as it is open.
    temp_file: TempFile,
    /// The length in bytes of what an earlier process left in the file.
    initial_length: u64,
}

/// The maximum number of attempts to lock the file; one fails if another process renames the file before it is locked.
const MAX_LOCK_ATTEMPTS: usize = 100;

impl Claim {
    /// Claims the file that a path leads to, as [`Destination`](crate::Destination) resolves it.
    ///
    /// # Errors
    /// [`io::ErrorKind::ResourceBusy`] if another process has it, and errors of the operating system.
    pub fn new(target: PathBuf) -> io::Result<Self> {
        let partial = sibling(&target, PARTIAL_EXTENSION);
        for _ in 0..MAX_LOCK_ATTEMPTS {
            let file = File::options()
                .read(true)
                .write(true)
                .create(true)
                .truncate(false)
                .open(&partial)
                .map_err(|error| error_with_path(&partial, &error))?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Err(busy_error()),
                Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
                Err(TryLockError::Error(error)) => return Err(error_with_path(&partial, &error)),
            }
            // Another process may have renamed the file before it was locked.
            if leads_to_file(&file, &partial)? {
                let metadata = file.metadata()?;
                if !metadata.is_file() {
                    let problem = format!("{} is no file", partial.display());
                    return Err(io::Error::new(io::ErrorKind::AlreadyExists, problem));
                }
                let initial_length = metadata.len();
                let temp_file = TempFile {
                    file,
                    path: partial,
                    target,
                    is_kept_on_drop: initial_length > 0,
                };
                return Ok(Claim {
                    temp_file,
                    initial_length,
                });
            }
        }
        Err(busy_error())
    }

    /// Returns the length in bytes of what an earlier process left in the file.
    pub fn initial_length(&self) -> u64 {
        self.initial_length
    }

    /// Returns the temporary path under which the file is written.
    pub fn partial_path(&self) -> &Path {
        &self.temp_file.path
    }

    /// Returns the final path of the file.
    pub fn target(&self) -> &Path {
        &self.temp_file.target
    }

    /// Returns the target path with an ending appended to the file name.
    pub fn sibling(&self, ending: &str) -> PathBuf {
        sibling(&self.temp_file.target, ending)
    }

    /// Returns the open file, which is empty or has the content that an earlier process left.
    pub fn file(&mut self) -> &mut File {
        &mut self.temp_file.file
    }

    /// Writes the whole file, and renames it to its target.
    ///
    /// # Errors
    /// Errors of `fill` and of [`Claim::rename_to_target`].
    pub fn write(mut self, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        self.truncate(0)?;
        write_buffered(&mut self.temp_file.file, fill)?;
        self.rename_to_target()
    }

    /// Truncates the file to a length in bytes, so that writing continues there.
    ///
    /// # Errors
    /// Errors of the operating system.
    pub fn truncate(&mut self, bytes: u64) -> io::Result<()> {
        self.file().set_len(bytes)?;
        self.file().seek(SeekFrom::Start(bytes))?;
        self.temp_file.is_kept_on_drop &= bytes > 0;
        Ok(())
    }

    /// Makes a dropped claim leave the file under its temporary name, instead of removing it.
    pub fn keep_on_drop(&mut self) {
        self.temp_file.is_kept_on_drop = true;
    }

    /// Renames the complete file to its target.
    ///
    /// # Errors
    /// The file was removed or replaced, or the operating system fails.
    pub fn rename_to_target(self) -> io::Result<()> {
        self.temp_file.place()
    }
}

fn busy_error() -> io::Error {
    let problem = "another run is writing it; wait for its end, or give another file";
    io::Error::new(io::ErrorKind::ResourceBusy, problem)
}
