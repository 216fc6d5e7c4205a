//! Temporary files that are renamed to their final names.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// A file with a unique temporary name, removed on drop unless it is placed.
pub(crate) struct TempFile {
    pub(crate) file: File,
    part: Option<PathBuf>,
    target: PathBuf,
}

impl TempFile {
    /// Creates a file beside the target with an unused name, because other threads and processes may write there too.
    pub(crate) fn new(target: PathBuf) -> io::Result<Self> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        loop {
            let count = COUNT.fetch_add(1, Ordering::Relaxed);
            let part = sibling(&target, &format!(".{}-{count}.part", std::process::id()));
            match File::create_new(&part) {
                // Left behind by a process with the same id.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error_with_path(&part, &error)),
                Ok(file) => {
                    let part = Some(part);
                    return Ok(TempFile { file, part, target });
                }
            }
        }
    }

    /// Renames the complete file to its target.
    pub(crate) fn place(mut self) -> io::Result<()> {
        if let Some(part) = &self.part {
            place(&self.file, part, &self.target)?;
            self.part = None;
        }
        Ok(())
    }
}

impl Drop for TempFile {
    fn drop(&mut self) {
        if let Some(part) = &self.part {
            // A file that stays behind does no harm.
            let _ = fs::remove_file(part);
        }
    }
}

/// Writes to a file or a stream through a buffer.
pub(crate) fn write_buffered(
    to: impl Write,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut buffer = BufWriter::new(to);
    let filled = fill(&mut buffer).and_then(|()| buffer.flush());
    // The rest of a failed write is dropped.
    drop(buffer.into_parts());
    filled
}

/// Renames a complete file to its target, after it is synced to disk.
pub(crate) fn place(file: &File, part: &Path, target: &Path) -> io::Result<()> {
    if let Ok(there) = fs::metadata(target) {
        // Some file systems have no permissions to set.
        let _ = file.set_permissions(there.permissions());
    }
    // Some file systems report a full disk only here.
    file.sync_all()?;
    fs::rename(part, target)
}

/// Returns the path with an ending appended to the file name.
pub(crate) fn sibling(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(ending);
    path.with_file_name(name)
}

/// Returns the error with the path added to its message.
pub(crate) fn error_with_path(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}
