//! Temporary files that are renamed to their final names.

use crate::destination::folder_to_open;
use same_file::Handle;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// The extension of temporary files.
const TEMP_EXTENSION: &str = ".part";

/// The maximum number of attempts to create a temporary file.
const MAX_CREATE_ATTEMPTS: usize = 1000;

/// A file under a temporary name in its target's folder; when it is complete, it is renamed to the target.
#[derive(Debug)]
pub(crate) struct TempFile {
    pub(crate) file: File,
    /// The temporary path, under which the file is written.
    pub(crate) path: PathBuf,
    pub(crate) target: PathBuf,
    /// Whether the file stays on disk if this value is dropped before the file has its final name.
    pub(crate) is_kept_on_drop: bool,
}

impl TempFile {
    /// Creates an empty file in the target's folder, under a name that no other thread or process uses.
    pub(crate) fn new(target: PathBuf) -> io::Result<Self> {
        static NEXT_FILE_NUMBER: AtomicU64 = AtomicU64::new(0);
        remove_abandoned_files_once(target.parent().unwrap_or(Path::new("")));
        for _ in 0..MAX_CREATE_ATTEMPTS {
            let count = NEXT_FILE_NUMBER.fetch_add(1, Ordering::Relaxed);
            let ending = format!(".{}-{count}{TEMP_EXTENSION}", std::process::id());
            let path = sibling(&target, &ending);
            match File::create_new(&path) {
                // Left behind by a process with the same id.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error_with_path(&path, &error)),
                Ok(file) => {
                    // The lock marks the file as in use. On a file system without locks, abandoned files stay.
                    let _ = file.try_lock();
                    // Before the lock, another process may have removed the file as an abandoned one.
                    if leads_to_file(&file, &path)? {
                        return Ok(TempFile {
                            file,
                            path,
                            target,
                            is_kept_on_drop: false,
                        });
                    }
                }
            }
        }
        Err(io::Error::other(
            "temporary files are removed as soon as they are made",
        ))
    }

    /// Renames the complete file to its target, after it is synced to disk.
    pub(crate) fn place(mut self) -> io::Result<()> {
        if !leads_to_file(&self.file, &self.path)? {
            let path = self.path.display();
            let problem = format!("{path} was removed or replaced while it was written");
            return Err(io::Error::new(io::ErrorKind::NotFound, problem));
        }
        if let Ok(metadata) = fs::metadata(&self.target) {
            // Some file systems have no permissions to set.
            let _ = self.file.set_permissions(metadata.permissions());
        }
        // Some file systems report a full disk only here.
        self.file.sync_all()?;
        fs::rename(&self.path, &self.target)?;
        self.is_kept_on_drop = true;
        Ok(())
    }
}

impl Drop for TempFile {
    fn drop(&mut self) {
        if !self.is_kept_on_drop && leads_to_file(&self.file, &self.path).unwrap_or(false) {
            // A file that stays behind does no harm.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Removes abandoned temporary files from a folder: the ones that no process has locked, because their processes have ended.
/// A process does this once for each folder.
fn remove_abandoned_files_once(folder: &Path) {
    static CLEANED_FOLDERS: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    let is_first_time = CLEANED_FOLDERS
        .lock()
        .is_ok_and(|mut cleaned_folders| cleaned_folders.insert(folder.to_owned()));
    let entries = is_first_time.then(|| fs::read_dir(folder_to_open(folder)).ok());
    for entry in entries.flatten().into_iter().flatten().flatten() {
        let name = entry.file_name();
        if name.to_str().is_some_and(is_temp_name)
            && entry.file_type().is_ok_and(|kind| kind.is_file())
        {
            // A file that cannot be removed does no harm.
            let _ = remove_if_abandoned(&entry.path());
        }
    }
}

/// Returns whether a name is one that [`TempFile::new`] gives: `NAME.PROCESS-COUNT.part`.
fn is_temp_name(name: &str) -> bool {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let ending = name
        .strip_suffix(TEMP_EXTENSION)
        .and_then(|name| name.rsplit_once('.'))
        .and_then(|(_, numbers)| numbers.split_once('-'));
    ending.is_some_and(|(process, count)| is_number(process) && is_number(count))
}

fn remove_if_abandoned(path: &Path) -> io::Result<()> {
    let file = File::options().write(true).open(path)?;
    file.try_lock()?;
    fs::remove_file(path)
}

/// Returns whether a path still leads to a given open file, rather than to a newer file or to none.
pub(crate) fn leads_to_file(file: &File, path: &Path) -> io::Result<bool> {
    match Handle::from_path(path) {
        Ok(metadata) => Ok(metadata == Handle::from_file(file.try_clone()?)?),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
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
