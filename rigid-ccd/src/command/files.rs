//! Tables read and written: files, or the standard streams.

use crate::table::courses::Courses;
use crate::table::csv_records::CsvRecords;
use crate::table::motions::MotionRows;
use crate::table::paths::Grouping;
use anyhow::{Context, Result, anyhow, bail};
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// An output that cannot be written; the input is not at fault.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {place}: {source}")]
pub struct CannotWrite {
    /// The file or stream.
    pub place: String,
    /// The reason.
    pub source: io::Error,
}

/// A table that is written row by row.
///
/// A file gets its final name once it is complete. Until then its rows are in a file next to it, whose
/// name ends in `.partial`. A pipe, a terminal or a device is written directly.
pub struct Table {
    name: String,
    writer: csv::Writer<CountingWriter>,
    pending: Option<PendingFile>,
}

/// The ending of the name of an incomplete table.
const PARTIAL: &str = ".partial";

/// The ending of the name of the journal.
pub(super) const RESUME: &str = ".resume";

/// A file with its final name and the name that it has until it is complete.
pub struct PendingFile {
    target: PathBuf,
    partial: PathBuf,
}

/// A writer that counts bytes.
pub struct CountingWriter {
    to: Box<dyn Write>,
    bytes: u64,
}

impl Table {
    /// Creates a table with its header; an existing file of that name is kept until the table is complete.
    pub fn create(path: &Path, header: &[&str]) -> Result<Self, CannotWrite> {
        let name = output_name(path);
        let failed = |source| CannotWrite {
            place: name.clone(),
            source,
        };
        let pending = PendingFile::find(path).map_err(failed)?;
        let to: Box<dyn Write> = match &pending {
            _ if is_standard(path) => Box::new(io::stdout().lock()),
            Some(pending) => Box::new(pending.create()?),
            None => Box::new(File::options().write(true).open(path).map_err(failed)?),
        };
        let mut table = Table::new(name, to, 0, pending);
        table.write(|writer| writer.write_record(header))?;
        Ok(table)
    }

    /// Continues a table after its first `bytes` bytes, and drops the rest.
    pub fn resume(pending: PendingFile, bytes: u64) -> Result<Self, CannotWrite> {
        let file = pending.open(bytes).map_err(|source| CannotWrite {
            place: pending.partial.display().to_string(),
            source,
        })?;
        let name = pending.target.display().to_string();
        Ok(Table::new(name, Box::new(file), bytes, Some(pending)))
    }

    fn new(name: String, to: Box<dyn Write>, bytes: u64, pending: Option<PendingFile>) -> Self {
        let mut builder = csv::WriterBuilder::new();
        let builder = builder.has_headers(false).buffer_capacity(1 << 16);
        Table {
            name,
            writer: builder.from_writer(CountingWriter { to, bytes }),
            pending,
        }
    }

    /// Adds a row.
    pub fn write(
        &mut self,
        row: impl FnOnce(&mut csv::Writer<CountingWriter>) -> Result<(), csv::Error>,
    ) -> Result<(), CannotWrite> {
        row(&mut self.writer).map_err(|error| self.failed(csv_cause(error)))
    }

    /// Flushes all rows, and returns the length of the table in bytes.
    pub fn flush(&mut self) -> Result<u64, CannotWrite> {
        let flushed = self.writer.flush();
        flushed.map_err(|source| self.failed(source))?;
        Ok(self.writer.get_ref().bytes)
    }

    /// Gives the file its final name.
    pub fn finish(mut self) -> Result<(), CannotWrite> {
        self.flush()?;
        match &self.pending {
            Some(PendingFile { target, partial }) => {
                fs::rename(partial, target).map_err(|source| self.failed(source))
            }
            None => Ok(()),
        }
    }

    fn failed(&self, source: io::Error) -> CannotWrite {
        CannotWrite {
            place: self.name.clone(),
            source,
        }
    }
}

impl Write for CountingWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

impl PendingFile {
    /// Finds both names of a file; returns none for a stream or a device.
    pub fn find(path: &Path) -> io::Result<Option<Self>> {
        if is_standard(path) {
            return Ok(None);
        }
        let target = match fs::metadata(path) {
            Ok(there) if there.is_dir() => {
                let problem = "it is a folder; give a file name";
                return Err(io::Error::new(io::ErrorKind::IsADirectory, problem));
            }
            Ok(there) if !there.is_file() => return Ok(None),
            Ok(_) => {
                // A file that must not be written must not be replaced either.
                File::options().write(true).open(path)?;
                fs::canonicalize(path)?
            }
            Err(_) => {
                check_folder(path)?;
                path.to_owned()
            }
        };
        if target.file_name().is_none() {
            let problem = "it is not a file name";
            return Err(io::Error::new(io::ErrorKind::InvalidFilename, problem));
        }
        let partial = sibling(&target, PARTIAL);
        Ok(Some(PendingFile { target, partial }))
    }

    /// The file that holds the rows until the table is complete.
    pub fn partial(&self) -> &Path {
        &self.partial
    }

    /// Returns the path of the file next to this one whose name has that ending.
    pub fn sibling(&self, ending: &str) -> PathBuf {
        sibling(&self.target, ending)
    }

    /// Renames a complete table of that length, if it still has its temporary name. Returns whether the
    /// table exists.
    ///
    /// # Errors
    /// Another file has the final name.
    pub fn give_final_name(&self, bytes: u64) -> Result<bool> {
        let length = |path: &Path| fs::metadata(path).ok().map(|there| there.len());
        if length(&self.partial) == Some(bytes) {
            fs::rename(&self.partial, &self.target).map_err(|source| CannotWrite {
                place: self.target.display().to_string(),
                source,
            })?;
        }
        match length(&self.target) {
            Some(there) if there != bytes => bail!(
                "--resume: {} has changed since the run finished; omit --resume to start over and \
                 overwrite it",
                self.target.display()
            ),
            there => Ok(there.is_some()),
        }
    }

    fn create(&self) -> Result<File, CannotWrite> {
        File::create(&self.partial).map_err(|source| CannotWrite {
            place: self.partial.display().to_string(),
            source,
        })
    }

    fn open(&self, bytes: u64) -> io::Result<File> {
        let mut file = File::options().write(true).open(&self.partial)?;
        if file.metadata()?.len() < bytes {
            let problem = "it is shorter than the interrupted run left it; delete it to start over";
            return Err(io::Error::new(io::ErrorKind::UnexpectedEof, problem));
        }
        file.set_len(bytes)?;
        file.seek(io::SeekFrom::End(0))?;
        Ok(file)
    }
}

/// Refuses a file that cannot be written, for want of its folder, before work is done for it.
pub(super) fn refuse_missing_folder(path: &Path) -> Result<(), CannotWrite> {
    check_folder(path).map_err(|source| CannotWrite {
        place: path.display().to_string(),
        source,
    })
}

/// Checks that the folder of a new file exists.
pub(super) fn check_folder(path: &Path) -> io::Result<()> {
    let folder = path.parent().filter(|folder| *folder != "");
    let Some(folder) = folder else {
        return Ok(());
    };
    let (kind, problem) = match fs::metadata(folder) {
        Ok(there) if there.is_dir() => return Ok(()),
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

fn sibling(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.file_name().map_or_else(OsString::new, OsString::from);
    name.push(ending);
    path.with_file_name(name)
}

fn csv_cause(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// Refuses an output that would overwrite an input, directly or by its temporary files.
pub fn refuse_overwriting(
    (read, source): (&str, &Path),
    (written, target): (&str, &Path),
) -> Result<()> {
    if is_standard(target) {
        return Ok(());
    }
    if same_file(source, target) {
        bail!("{written} would overwrite the file of {read}; give {written} another file");
    }
    for ending in [PARTIAL, RESUME] {
        let pending = sibling(target, ending);
        if same_file(source, &pending) {
            let pending = pending.display();
            bail!(
                "{written} would overwrite {pending}, the file of {read}; give {written} another file"
            );
        }
    }
    Ok(())
}

/// The bytes of a table from any source.
type Source = Box<dyn Read>;

/// Opens the table of motions, and returns its length in bytes if known.
pub fn open_motions(path: &Path) -> Result<(MotionRows<CsvRecords<Source>>, Option<u64>)> {
    let (input, length) = open_table(path)?;
    let rows = MotionRows::new(input).with_context(|| input_name(path))?;
    Ok((rows, length))
}

/// The rows of a table of motions or paths from any source.
pub(super) type Rows = Courses<CsvRecords<Source>>;

/// Opens a table of motions or paths, and returns its length in bytes if known.
pub(super) fn open_courses(path: &Path, grouping: Grouping) -> Result<(Rows, Option<u64>)> {
    let (input, length) = open_table(path)?;
    let rows = Courses::new(input, grouping).with_context(|| input_name(path))?;
    Ok((rows, length))
}

fn open_table(path: &Path) -> Result<(Source, Option<u64>)> {
    let name = || input_name(path);
    let advice = "give --motions a CSV file, or - for standard input";
    if is_standard(path) {
        return Ok((Box::new(io::stdin().lock()), None));
    }
    let open = || -> io::Result<_> {
        let file = File::open(path)?;
        let about = file.metadata()?;
        Ok((file, about))
    };
    let (file, about) = open()
        .map_err(|error| anyhow!("{error}; {advice}"))
        .with_context(name)?;
    if about.is_dir() {
        bail!("{}: is a folder; {advice}", name());
    }
    let length = about.is_file().then_some(about.len());
    Ok((Box::new(file), length))
}

/// Returns the name of an input for messages.
pub fn input_name(path: &Path) -> String {
    match is_standard(path) {
        true => "standard input".to_owned(),
        false => path.display().to_string(),
    }
}

fn output_name(path: &Path) -> String {
    match is_standard(path) {
        true => "standard output".to_owned(),
        false => path.display().to_string(),
    }
}

pub(super) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Returns whether two paths lead to one file, or would if it existed.
pub fn same_file(a: &Path, b: &Path) -> bool {
    a == b || real_path(a).is_some_and(|a| Some(a) == real_path(b))
}

fn real_path(path: &Path) -> Option<PathBuf> {
    let missing = || {
        let folder = match path.parent()? {
            here if here.as_os_str().is_empty() => Path::new("."),
            folder => folder,
        };
        Some(fs::canonicalize(folder).ok()?.join(path.file_name()?))
    };
    fs::canonicalize(path).ok().or_else(missing)
}
