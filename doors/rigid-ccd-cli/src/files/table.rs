//! Writes a CSV table row by row, to a file or a stream.

use crate::files::output::{Output, OutputError};
use ccd_file::Claim;
use serde::{Deserialize, Serialize};
use std::io::{self, Read, Seek, Write};
use std::path::Path;

/// A CSV table that is written row by row.
///
/// A file gets its final name once it is complete. Until then its rows are in a file next to it, whose name
/// ends in `.partial`. This file stays if the run is interrupted. A stream is written directly.
pub struct TableWriter {
    output: Output,
    writer: csv::Writer<MeasuringWriter>,
}

/// The length in bytes and the checksum of the part of a table that has been written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct LengthAndChecksum {
    pub(crate) bytes: u64,
    pub(crate) checksum: u32,
}

/// A writer that counts and checksums the bytes written.
pub struct MeasuringWriter {
    destination: Box<dyn Write>,
    bytes: u64,
    checksum: crc32fast::Hasher,
}

impl TableWriter {
    /// Creates a table with its header; an existing file is kept until the new table is complete.
    pub fn create(path: &Path, header: &[&str]) -> Result<Self, OutputError> {
        TableWriter::start(Output::claim_table(path)?, header)
    }

    /// Starts a table in a reserved output, and discards what an earlier run left there.
    pub(crate) fn start(mut output: Output, header: &[&str]) -> Result<Self, OutputError> {
        let truncated = output
            .reserved_file
            .as_mut()
            .map_or(Ok(()), |claim| claim.truncate(0));
        let opened = truncated.and_then(|()| output.open());
        let destination = opened.map_err(|source| output.error(source))?;
        let mut table = TableWriter::new(output, MeasuringWriter::new(destination));
        table.write_row(|writer| writer.write_record(header))?;
        Ok(table)
    }

    /// Continues a table after its first part, which has the length and checksum `written`, and removes the rest.
    /// Returns `None` if that part has changed since, or the output is a stream.
    pub(crate) fn resume(
        mut output: Output,
        written: LengthAndChecksum,
    ) -> Result<Option<Self>, OutputError> {
        let mut open = || {
            let Some(claim) = &mut output.reserved_file else {
                return Ok(None);
            };
            claim.file().rewind()?;
            let measured = measure_beginning(claim.file(), written.bytes)?;
            if measured.length_and_checksum() != written {
                return Ok(None);
            }
            claim.truncate(written.bytes)?;
            let destination = output.open()?;
            Ok(Some(MeasuringWriter {
                destination,
                ..measured
            }))
        };
        let opened = open().map_err(|source| output.error(source))?;
        Ok(opened.map(|writer| TableWriter::new(output, writer)))
    }

    fn new(output: Output, writer: MeasuringWriter) -> Self {
        let mut builder = csv::WriterBuilder::new();
        let builder = builder.has_headers(false).buffer_capacity(1 << 16);
        TableWriter {
            output,
            writer: builder.from_writer(writer),
        }
    }

    /// Adds a row, which the function `row` writes.
    pub fn write_row(
        &mut self,
        write: impl FnOnce(&mut csv::Writer<MeasuringWriter>) -> Result<(), csv::Error>,
    ) -> Result<(), OutputError> {
        write(&mut self.writer).map_err(|error| self.output.error(io_error_from_csv(error)))
    }

    /// Adds a row, given as serialisable cells.
    pub(crate) fn add_row(&mut self, cells: &impl Serialize) -> Result<(), OutputError> {
        self.write_row(|writer| writer.serialize(cells))
    }

    /// Flushes all rows to the file, so that they survive an interruption.
    pub fn flush(&mut self) -> Result<(), OutputError> {
        self.flush_and_measure().map(|_| ())
    }

    /// Flushes all rows to the file, and returns the length and checksum of the table.
    pub(crate) fn flush_and_measure(&mut self) -> Result<LengthAndChecksum, OutputError> {
        let flushed = self.writer.flush();
        flushed.map_err(|source| self.output.error(source))?;
        if let Some(claim) = &mut self.output.reserved_file {
            claim.keep_on_drop();
        }
        Ok(self.writer.get_ref().length_and_checksum())
    }

    /// Renames the complete table to its final name.
    pub fn finish(mut self) -> Result<(), OutputError> {
        self.flush()?;
        let renamed = self
            .output
            .reserved_file
            .take()
            .map_or(Ok(()), Claim::rename_to_target);
        renamed.map_err(|source| self.output.error(source))
    }
}

impl MeasuringWriter {
    fn new(destination: Box<dyn Write>) -> Self {
        MeasuringWriter {
            destination,
            bytes: 0,
            checksum: crc32fast::Hasher::new(),
        }
    }

    pub(crate) fn length_and_checksum(&self) -> LengthAndChecksum {
        LengthAndChecksum {
            bytes: self.bytes,
            checksum: self.checksum.clone().finalize(),
        }
    }
}

impl Write for MeasuringWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.destination.write(bytes)?;
        self.bytes += written as u64;
        self.checksum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.destination.flush()
    }
}

/// Reads the first `bytes` bytes of a table, and returns a writer to nowhere that has measured them.
pub(crate) fn measure_beginning(table: impl Read, bytes: u64) -> io::Result<MeasuringWriter> {
    let mut measured = MeasuringWriter::new(Box::new(io::sink()));
    io::copy(&mut table.take(bytes), &mut measured)?;
    Ok(measured)
}

fn io_error_from_csv(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}
