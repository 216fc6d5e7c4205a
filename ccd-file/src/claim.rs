//! Files that one process writes at a time.

use crate::beside::{buffered, naming, place, sibling};
use same_file::Handle;
use std::fs::{self, File, TryLockError};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The ending of the name of a claimed file.
pub const PARTIAL: &str = ".partial";

/// A file that this process alone writes, under a temporary name beside its final one.
///
/// # Guarantee
/// Of all that claim the same file at the same time, by whatever name, one gets it. The operating system gives it free
/// when the process ends, however it ends. A file system that knows no locks is an exception: there all get it.
///
/// A claim that is dropped removes its file, unless that held something when it was claimed, or is
/// [kept](Claim::keep).
#[derive(Debug)]
pub struct Claim {
    /// Locked as long as it is open.
    file: File,
    partial: PathBuf,
    target: PathBuf,
    /// The number of bytes that an earlier process left.
    left: u64,
    end: End,
}

/// What becomes of a file that is dropped without its final name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    Removed,
    Kept,
}

/// The most times that others may finish between opening a file and locking it.
const TRIES: usize = 100;

impl Claim {
    /// Claims the file at the end of a path, as [`Destination`](crate::Destination) has it.
    ///
    /// # Errors
    /// [`io::ErrorKind::ResourceBusy`] when another process has it, and whatever the operating system refuses.
    pub fn new(target: PathBuf) -> io::Result<Self> {
        let partial = sibling(&target, PARTIAL);
        for _ in 0..TRIES {
            let options = File::options()
                .read(true)
                .write(true)
                .create(true)
                .truncate(false)
                .clone();
            let file = options
                .open(&partial)
                .map_err(|error| naming(&partial, &error))?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Err(busy()),
                Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
                Err(TryLockError::Error(error)) => return Err(naming(&partial, &error)),
            }
            // Before it was locked, whoever had it may have given it its final name.
            if is_at(&file, &partial)? {
                let about = file.metadata()?;
                if !about.is_file() {
                    let problem = format!("{} is no file", partial.display());
                    return Err(io::Error::new(io::ErrorKind::AlreadyExists, problem));
                }
                let left = about.len();
                let end = if left == 0 { End::Removed } else { End::Kept };
                return Ok(Claim {
                    file,
                    partial,
                    target,
                    left,
                    end,
                });
            }
        }
        Err(busy())
    }

    /// The number of bytes that an earlier process left in the file.
    pub fn left(&self) -> u64 {
        self.left
    }

    /// The temporary name.
    pub fn partial(&self) -> &Path {
        &self.partial
    }

    /// The final name.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Returns the path of a file beside the final one, whose name has one more ending.
    pub fn sibling(&self, ending: &str) -> PathBuf {
        sibling(&self.target, ending)
    }

    /// The file; it is empty or has what an earlier process left.
    pub fn file(&mut self) -> &mut File {
        &mut self.file
    }

    /// Writes the whole file in one go, and gives it its final name.
    ///
    /// # Errors
    /// What `fill` returns, and those of [`Claim::place`].
    pub fn write(mut self, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        self.cut(0)?;
        buffered(&mut self.file, fill)?;
        self.place()
    }

    /// Drops all but the first bytes of the file, and goes on behind them.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn cut(&mut self, bytes: u64) -> io::Result<()> {
        self.file.set_len(bytes)?;
        self.file.seek(SeekFrom::Start(bytes))?;
        if bytes == 0 {
            self.end = End::Removed;
        }
        Ok(())
    }

    /// Keeps the file under its temporary name if it never gets its final one.
    pub fn keep(&mut self) {
        self.end = End::Kept;
    }

    /// Gives the complete file its final name.
    ///
    /// # Errors
    /// Someone has removed or replaced the file, or the operating system refuses.
    pub fn place(mut self) -> io::Result<()> {
        if !is_at(&self.file, &self.partial)? {
            self.end = End::Kept;
            let partial = self.partial.display();
            let problem = format!("{partial} was removed or replaced while it was written");
            return Err(io::Error::new(io::ErrorKind::NotFound, problem));
        }
        place(&self.file, &self.partial, &self.target)?;
        self.end = End::Kept;
        Ok(())
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        if self.end == End::Removed && is_at(&self.file, &self.partial).unwrap_or(false) {
            // What stays behind does no harm.
            let _ = fs::remove_file(&self.partial);
        }
    }
}

fn busy() -> io::Error {
    let problem = "another run is writing it; wait for its end, or give another file";
    io::Error::new(io::ErrorKind::ResourceBusy, problem)
}

/// Returns whether a path still leads to a file.
fn is_at(file: &File, path: &Path) -> io::Result<bool> {
    match Handle::from_path(path) {
        Ok(there) => Ok(there == Handle::from_file(file.try_clone()?)?),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    }
}
