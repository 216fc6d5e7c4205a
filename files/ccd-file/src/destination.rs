//! Finds out where an output path leads: to a file, which can be replaced, or to a stream.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// The target of an output path: a file, which can be replaced, or a stream, which can only be written to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Destination {
    /// A regular file, existing or not, by its path after following links.
    File(PathBuf),
    /// A pipe, a terminal, a device, or an open file of this process such as `/dev/stdout`.
    Stream,
}

/// The maximum number of symbolic links followed, the same as on Linux.
const MAX_LINKS: usize = 40;

impl Destination {
    /// Resolves a path, and checks that a file may be written there.
    ///
    /// # Errors
    /// The path is a folder, a read-only file, or in a folder that does not exist.
    pub fn resolve(path: &Path) -> io::Result<Self> {
        match fs::metadata(path) {
            Ok(metadata) if metadata.is_dir() => {
                let problem = "it is a folder; give a file name";
                Err(io::Error::new(io::ErrorKind::IsADirectory, problem))
            }
            Ok(metadata) if !metadata.is_file() || is_descriptor_path(path) => {
                Ok(Destination::Stream)
            }
            Ok(_) => {
                // A file that must not be written must not be replaced either.
                File::options().write(true).open(path)?;
                Ok(Destination::File(fs::canonicalize(path)?))
            }
            Err(_) => {
                let target = resolve_links(path)?;
                check_parent_folder(&target)?;
                if target.file_name().is_none() {
                    let problem = "it is not a file name";
                    return Err(io::Error::new(io::ErrorKind::InvalidFilename, problem));
                }
                Ok(Destination::File(target))
            }
        }
    }
}

/// Checks that the folder in which a file is to be created exists.
///
/// # Errors
/// The folder does not exist, or is not a folder.
pub fn check_parent_folder(path: &Path) -> io::Result<()> {
    let folder = path.parent().filter(|folder| *folder != "");
    let Some(folder) = folder else {
        return Ok(());
    };
    let (kind, problem) = match fs::metadata(folder) {
        Ok(metadata) if metadata.is_dir() => return Ok(()),
        Ok(_) => (io::ErrorKind::NotADirectory, "is not a folder"),
        Err(error) if error.kind() == io::ErrorKind::NotFound => (
            error.kind(),
            "is a folder that does not exist; create it first",
        ),
        Err(error) => return Err(error),
    };
    Err(io::Error::new(
        kind,
        format!("{} {problem}", folder.display()),
    ))
}

/// Returns a folder as a path to open: the parent of a bare file name is empty, and means the current folder `.`.
pub fn folder_to_open(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    }
}

/// Opens a path such as `/dev/stdout` for appending, so that a file behind it keeps its content.
pub(crate) fn open_stream(path: &Path) -> io::Result<File> {
    File::options().append(true).open(path)
}

/// Returns whether a path names an open file of a process, such as `/dev/stdout`, which cannot be replaced by a rename.
pub(crate) fn is_descriptor_path(path: &Path) -> bool {
    let standard_streams = ["/dev/stdin", "/dev/stdout", "/dev/stderr"];
    let in_proc = || path.starts_with("/proc") && path.parent().is_some_and(|p| p.ends_with("fd"));
    standard_streams.iter().any(|name| path == Path::new(name))
        || path.starts_with("/dev/fd")
        || in_proc()
}

/// Returns the target of a path that is a symbolic link, also if the target does not exist.
///
/// # Errors
/// The links form a cycle.
pub fn resolve_links(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_owned();
    for _ in 0..MAX_LINKS {
        match fs::read_link(&target) {
            Ok(next) => target = target.parent().unwrap_or(Path::new("")).join(next),
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other("it is a link that leads to itself"))
}
