//! Writes a CSV table row by row, to a file or a stream.

use super::output::{Output, OutputError, is_standard_output};
use ccd_file::Claim;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::{self, Read, Seek, Write};
use std::path::Path;

/// A CSV table that is written row by row.
///
/// A file gets its final name once it is complete. Until then its rows are in a file next to it, whose
/// name ends in `.partial`, and which stays if the run is interrupted. A stream is written directly.
pub struct TableWriter {
    name: String,
    writer: csv::Writer<MeasuringWriter>,
    claim: Option<Claim>,
}

/// The length in bytes and the checksum of the part of a table that has been written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct LengthAndChecksum {
    pub(super) bytes: u64,
    pub(super) checksum: u32,
}

/// A writer that counts and checksums the bytes written.
pub struct MeasuringWriter {
    to: Box<dyn Write>,
    bytes: u64,
    checksum: crc32fast::Hasher,
}

impl TableWriter {
    /// Creates a table with its header; an existing file is kept until the new table is complete.
    pub fn create(path: &Path, header: &[&str]) -> Result<Self, OutputError> {
        TableWriter::start(Output::claim_table(path)?, header)
    }

    /// Starts a table in a reserved output, and discards what an earlier run left there.
    pub(super) fn start(output: Output, header: &[&str]) -> Result<Self, OutputError> {
        let name = output.name();
        let opened = match output {
            Output::File(mut claim, _) => claim
                .truncate(0)
                .and_then(|()| cloned_file(&mut claim))
                .map(|to| (to, Some(claim))),
            Output::Stream(path) if is_standard_output(&path) => {
                Ok((Box::new(io::stdout().lock()) as Box<dyn Write>, None))
            }
            Output::Stream(path) => {
                let file = File::options().append(true).open(path);
                file.map(|file| (Box::new(file) as Box<dyn Write>, None))
            }
        };
        let (to, claim) = opened.map_err(|source| OutputError {
            file_or_stream: name.clone(),
            source,
        })?;
        let measured = MeasuringWriter {
            to,
            bytes: 0,
            checksum: crc32fast::Hasher::new(),
        };
        let mut table = TableWriter::new(name, measured, claim);
        table.write(|writer| writer.write_record(header))?;
        Ok(table)
    }

    /// Continues a table after the part that was `written`, and truncates what follows. Returns `None` if that part has
    /// changed since.
    pub(super) fn resume(
        mut claim: Claim,
        written: LengthAndChecksum,
    ) -> Result<Option<Self>, OutputError> {
        let name = claim.target().display().to_string();
        let opened = (|| {
            claim.file().rewind()?;
            let (found, checksum) = measure_beginning(claim.file(), written.bytes)?;
            if found != written {
                return Ok(None);
            }
            claim.truncate(written.bytes)?;
            let to = cloned_file(&mut claim)?;
            Ok(Some(MeasuringWriter {
                to,
                bytes: written.bytes,
                checksum,
            }))
        })();
        match opened {
            Ok(measured) => {
                Ok(measured.map(|measured| TableWriter::new(name, measured, Some(claim))))
            }
            Err(source) => Err(OutputError {
                file_or_stream: name,
                source,
            }),
        }
    }

    fn new(name: String, measured: MeasuringWriter, claim: Option<Claim>) -> Self {
        let mut builder = csv::WriterBuilder::new();
        let builder = builder.has_headers(false).buffer_capacity(1 << 16);
        TableWriter {
            name,
            writer: builder.from_writer(measured),
            claim,
        }
    }

    /// Adds a row, which the function `row` writes.
    pub fn write(
        &mut self,
        row: impl FnOnce(&mut csv::Writer<MeasuringWriter>) -> Result<(), csv::Error>,
    ) -> Result<(), OutputError> {
        row(&mut self.writer).map_err(|error| self.output_error(io_error_from_csv(error)))
    }

    /// Adds a row, given as serialisable cells.
    pub(super) fn row(&mut self, cells: &impl Serialize) -> Result<(), OutputError> {
        self.write(|writer| writer.serialize(cells))
    }

    /// Flushes all rows to the file, so that they survive an interruption.
    pub fn flush(&mut self) -> Result<(), OutputError> {
        self.flush_and_measure().map(|_| ())
    }

    /// Flushes all rows to the file, and returns the length and checksum of the table.
    pub(super) fn flush_and_measure(&mut self) -> Result<LengthAndChecksum, OutputError> {
        let flushed = self.writer.flush();
        flushed.map_err(|source| self.output_error(source))?;
        if let Some(claim) = &mut self.claim {
            claim.keep_on_drop();
        }
        let MeasuringWriter {
            bytes, checksum, ..
        } = self.writer.get_ref();
        Ok(LengthAndChecksum {
            bytes: *bytes,
            checksum: checksum.clone().finalize(),
        })
    }

    /// Renames the complete table to its final name.
    pub fn finish(mut self) -> Result<(), OutputError> {
        self.flush()?;
        match self.claim.take().map_or(Ok(()), Claim::place) {
            Ok(()) => Ok(()),
            Err(source) => Err(self.output_error(source)),
        }
    }

    fn output_error(&self, source: io::Error) -> OutputError {
        OutputError {
            file_or_stream: self.name.clone(),
            source,
        }
    }
}

impl Write for MeasuringWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.bytes += written as u64;
        self.checksum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

fn cloned_file(claim: &mut Claim) -> io::Result<Box<dyn Write>> {
    Ok(Box::new(claim.file().try_clone()?))
}

/// Returns the length and checksum of the first `bytes` bytes of a table, with a hasher that can continue the checksum.
pub(super) fn measure_beginning(
    table: impl Read,
    bytes: u64,
) -> io::Result<(LengthAndChecksum, crc32fast::Hasher)> {
    let mut measured = MeasuringWriter {
        to: Box::new(io::sink()),
        bytes: 0,
        checksum: crc32fast::Hasher::new(),
    };
    io::copy(&mut table.take(bytes), &mut measured)?;
    let checksum = measured.checksum;
    let written = LengthAndChecksum {
        bytes: measured.bytes,
        checksum: checksum.clone().finalize(),
    };
    Ok((written, checksum))
}

fn io_error_from_csv(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}
