//! Reads whole files, and refuses devices and pipes that might never end.

use crate::destination::is_descriptor_path;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// The greatest length in bytes of a file that is read whole.
pub const MAX_FILE_BYTES: u64 = 1 << 32;

/// The greatest number of bytes that are read from a pipe, whose length is not known in advance.
pub const MAX_PIPE_BYTES: u64 = 1 << 28;

/// Opens a file that is read to its end.
///
/// It is a regular file, or an open pipe of this process such as `/dev/stdin`. Devices may never end, and opening a named
/// pipe may wait for ever.
///
/// # Errors
/// The path leads to anything else, or the operating system fails.
pub fn open(path: impl AsRef<Path>) -> io::Result<File> {
    Ok(open_bounded(path.as_ref())?.0)
}

/// Opens a file, and returns the greatest number of bytes that are read of it.
fn open_bounded(path: &Path) -> io::Result<(File, u64)> {
    let metadata = fs::metadata(path)?;
    if metadata.is_file() {
        return Ok((File::open(path)?, MAX_FILE_BYTES));
    }
    if metadata.is_dir() {
        return Err(io::Error::new(
            io::ErrorKind::IsADirectory,
            "it is a folder",
        ));
    }
    if is_descriptor_path(path) && is_pipe(&metadata) {
        return Ok((File::open(path)?, MAX_PIPE_BYTES));
    }
    Err(io::Error::other(
        "it is a device or a named pipe, which may never end; give a file",
    ))
}

/// Reads a whole file, of the kinds that [`open`] opens.
///
/// # Errors
/// The errors of [`open`]; or a file is longer than [`MAX_FILE_BYTES`], or a pipe gives more than [`MAX_PIPE_BYTES`].
///
/// ```
/// assert!(ccd_file::read(std::env::temp_dir()).is_err());
/// ```
pub fn read(path: impl AsRef<Path>) -> io::Result<Vec<u8>> {
    let (file, max_bytes) = open_bounded(path.as_ref())?;
    let mut bytes = Vec::new();
    if file.metadata()?.len() <= max_bytes {
        file.take(max_bytes + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 <= max_bytes {
            return Ok(bytes);
        }
    }
    let problem = format!("it has more than {max_bytes} bytes");
    Err(io::Error::new(io::ErrorKind::FileTooLarge, problem))
}

/// Reads a whole file as text in UTF-8.
///
/// # Errors
/// The errors of [`read`], or the content is not UTF-8.
pub fn read_to_string(path: impl AsRef<Path>) -> io::Result<String> {
    String::from_utf8(read(path)?)
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is not text in UTF-8"))
}

#[cfg(unix)]
fn is_pipe(metadata: &fs::Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    metadata.file_type().is_fifo() || metadata.file_type().is_socket()
}

#[cfg(not(unix))]
fn is_pipe(_: &fs::Metadata) -> bool {
    false
}
