//! Tables in and out: files, or the standard streams.

use crate::table::motions::MotionRows;
use anyhow::{Context, Result, anyhow, bail};
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// Results that have nowhere to go: not the input's fault.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {place}: {source}")]
pub struct CannotWrite {
    /// The file or stream.
    pub place: String,
    /// Why it cannot be written.
    pub source: io::Error,
}

/// A table that is written row by row.
///
/// A file gets its name once it is whole. Until then its rows are in one beside it, the name of which
/// ends in [`PARTIAL`]; what has no length, such as a pipe or a terminal, is written to as it is.
pub struct Table {
    name: String,
    writer: csv::Writer<Counted>,
    beside: Option<Beside>,
}

/// What the name of a file ends in that is not whole yet.
const PARTIAL: &str = ".partial";

/// What the name of the journal ends in that stands beside it.
pub(super) const RESUME: &str = ".resume";

/// Where a file is going to be, and where it is until then.
pub struct Beside {
    target: PathBuf,
    partial: PathBuf,
}

/// Counts what is written.
pub struct Counted {
    to: Box<dyn Write>,
    bytes: u64,
}

impl Table {
    /// Begins a table with its header; the file of that name is left as it is.
    pub fn create(path: &Path, header: &[&str]) -> Result<Self, CannotWrite> {
        let name = output_name(path);
        let failed = |source| CannotWrite {
            place: name.clone(),
            source,
        };
        let beside = Beside::find(path).map_err(failed)?;
        let to: Box<dyn Write> = match &beside {
            _ if is_standard(path) => Box::new(io::stdout().lock()),
            Some(beside) => Box::new(beside.create()?),
            None => Box::new(File::options().write(true).open(path).map_err(failed)?),
        };
        let mut table = Table::new(name, to, 0, beside);
        table.write(|writer| writer.write_record(header))?;
        Ok(table)
    }

    /// Goes on with one of which so many bytes are to be kept; what stands behind is dropped.
    pub fn resume(beside: Beside, bytes: u64) -> Result<Self, CannotWrite> {
        let file = beside.open(bytes).map_err(|source| CannotWrite {
            place: beside.partial.display().to_string(),
            source,
        })?;
        let name = beside.target.display().to_string();
        Ok(Table::new(name, Box::new(file), bytes, Some(beside)))
    }

    fn new(name: String, to: Box<dyn Write>, bytes: u64, beside: Option<Beside>) -> Self {
        let mut builder = csv::WriterBuilder::new();
        let builder = builder.has_headers(false).buffer_capacity(1 << 16);
        Table {
            name,
            writer: builder.from_writer(Counted { to, bytes }),
            beside,
        }
    }

    /// Adds a row.
    pub fn write(
        &mut self,
        row: impl FnOnce(&mut csv::Writer<Counted>) -> Result<(), csv::Error>,
    ) -> Result<(), CannotWrite> {
        row(&mut self.writer).map_err(|error| self.failed(csv_cause(error)))
    }

    /// Hands all rows on; says how many bytes the table has now.
    pub fn flush(&mut self) -> Result<u64, CannotWrite> {
        let flushed = self.writer.flush();
        flushed.map_err(|source| self.failed(source))?;
        Ok(self.writer.get_ref().bytes)
    }

    /// Gives the file its name.
    pub fn finish(mut self) -> Result<(), CannotWrite> {
        self.flush()?;
        match &self.beside {
            Some(Beside { target, partial }) => {
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

impl Write for Counted {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

impl Beside {
    /// Where the parts of a file are; none for what is no file.
    pub fn find(path: &Path) -> io::Result<Option<Self>> {
        if is_standard(path) {
            return Ok(None);
        }
        let target = match fs::metadata(path) {
            Ok(there) if there.is_dir() => {
                let problem = "it is a folder; name a file";
                return Err(io::Error::new(io::ErrorKind::IsADirectory, problem));
            }
            Ok(there) if !there.is_file() => return Ok(None),
            Ok(_) => {
                // Whoever may not write to the file may not put another in its place either.
                File::options().write(true).open(path)?;
                fs::canonicalize(path)?
            }
            Err(_) => {
                check_folder(path)?;
                path.to_owned()
            }
        };
        if target.file_name().is_none() {
            let problem = "it names no file";
            return Err(io::Error::new(io::ErrorKind::InvalidFilename, problem));
        }
        let partial = with_ending(&target, PARTIAL);
        Ok(Some(Beside { target, partial }))
    }

    /// The file of the parts.
    pub fn partial(&self) -> &Path {
        &self.partial
    }

    /// A file that goes with them.
    pub fn with_ending(&self, ending: &str) -> PathBuf {
        with_ending(&self.target, ending)
    }

    /// Whether the table is there that was finished with so many bytes; it gets its name if it has none
    /// yet.
    ///
    /// # Errors
    /// When another file has the name.
    pub fn name_whole(&self, bytes: u64) -> Result<bool> {
        let length = |path: &Path| fs::metadata(path).ok().map(|there| there.len());
        if length(&self.partial) == Some(bytes) {
            fs::rename(&self.partial, &self.target).map_err(|source| CannotWrite {
                place: self.target.display().to_string(),
                source,
            })?;
        }
        match length(&self.target) {
            Some(there) if there != bytes => bail!(
                "--resume: {} is not as the finished run left it; leave out --resume to begin again and \
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
            let problem = "rows are missing that an earlier run wrote; delete it to begin again";
            return Err(io::Error::new(io::ErrorKind::UnexpectedEof, problem));
        }
        file.set_len(bytes)?;
        file.seek(io::SeekFrom::End(0))?;
        Ok(file)
    }
}

/// Says so where the folder is not there that a file is to be in.
pub(super) fn check_folder(path: &Path) -> io::Result<()> {
    let folder = path.parent().filter(|folder| *folder != "");
    let Some(folder) = folder else {
        return Ok(());
    };
    let (kind, problem) = match fs::metadata(folder) {
        Ok(there) if there.is_dir() => return Ok(()),
        Ok(_) => (io::ErrorKind::NotADirectory, "is no folder"),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            (error.kind(), "is a folder that is not there; make it first")
        }
        Err(error) => return Err(error),
    };
    Err(io::Error::new(
        kind,
        format!("{} {problem}", folder.display()),
    ))
}

fn with_ending(path: &Path, ending: &str) -> PathBuf {
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

/// Refuses to have two options name one file, of which the second one is written to, or what stands beside
/// it until it is whole.
pub fn refuse_overwriting(
    (read, source): (&str, &Path),
    (written, target): (&str, &Path),
) -> Result<()> {
    if is_standard(target) {
        return Ok(());
    }
    if same_file(source, target) {
        bail!("{written} names the file of {read}, which it would overwrite; give it another");
    }
    for ending in [PARTIAL, RESUME] {
        let beside = with_ending(target, ending);
        if same_file(source, &beside) {
            let beside = beside.display();
            bail!("{written} is put together in {beside}, the file of {read}; give it another");
        }
    }
    Ok(())
}

/// Rows of motions from anywhere.
pub(super) type Motions = MotionRows<Box<dyn Read>>;

/// The table of motions, of which `--motions` names the file, and how many bytes it has where that is
/// known.
pub fn open_motions(path: &Path) -> Result<(Motions, Option<u64>)> {
    let name = || input_name(path);
    let advice = "give --motions a CSV file, or - for standard input";
    if is_standard(path) {
        let input: Box<dyn Read> = Box::new(io::stdin().lock());
        return Ok((MotionRows::new(input).with_context(name)?, None));
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
    let input: Box<dyn Read> = Box::new(file);
    Ok((MotionRows::new(input).with_context(name)?, length))
}

/// What messages call a file that is read.
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

/// Returns whether two paths lead to one file.
pub fn same_file(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| fs::canonicalize(path).ok();
    a == b || real(a).is_some_and(|a| Some(a) == real(b))
}
