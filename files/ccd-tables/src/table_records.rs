//! Reads a table in any format that this build knows, which it recognises by the first bytes.

use crate::csv_records::CsvRecords;
use crate::error::TableError;
use crate::foreign::PARQUET_SIGNATURE;
#[cfg(feature = "parquet")]
use crate::parquet_records::ParquetRecords;
use crate::position::RowPosition;
use crate::records::Records;
use std::fs::File;
use std::io::{self, Cursor, Read};

/// The rows of a table in CSV or, with the feature `parquet`, in Parquet.
pub struct TableRecords(Box<dyn Records<Record = csv::ByteRecord>>);

impl TableRecords {
    /// Opens a table from a file. Parquet needs a regular file, not a pipe.
    ///
    /// The first Parquet file replaces the panic hook of the process. The new hook ignores panics of the Parquet library, which
    /// become errors, and passes all others to the old hook.
    ///
    /// # Errors
    /// Those of [`TableRecords::from_stream`], [`TableError::Parquet`], [`TableError::ColumnType`].
    pub fn from_file(mut file: File) -> Result<Self, TableError> {
        let start = first_bytes(&mut file)?;
        #[cfg(feature = "parquet")]
        if start == PARQUET_SIGNATURE && file.metadata().map_err(unreadable)?.is_file() {
            let records = ParquetRecords::new(file)?;
            return Ok(TableRecords(Box::new(records)));
        }
        TableRecords::from_text(start, file)
    }

    /// Opens a table from a stream. It cannot be Parquet, because the last bytes of a Parquet file locate all others.
    ///
    /// # Errors
    /// Those of [`CsvRecords::new`], [`TableError::ParquetStream`].
    pub fn from_stream(mut input: impl Read + 'static) -> Result<Self, TableError> {
        let start = first_bytes(&mut input)?;
        TableRecords::from_text(start, input)
    }

    /// Opens a table in CSV, whose first bytes have been read.
    fn from_text(start: Vec<u8>, rest: impl Read + 'static) -> Result<Self, TableError> {
        // Without the feature, the CSV reader says that this is no CSV.
        if cfg!(feature = "parquet") && start == PARQUET_SIGNATURE {
            return Err(TableError::ParquetStream);
        }
        let input: Box<dyn Read> = Box::new(Cursor::new(start).chain(rest));
        let records = CsvRecords::new(input)?;
        Ok(TableRecords(Box::new(records)))
    }
}

/// Reads as many bytes as tell Parquet from text; fewer if the table is shorter.
fn first_bytes(input: &mut impl Read) -> Result<Vec<u8>, TableError> {
    let mut start = Vec::new();
    let length = PARQUET_SIGNATURE.len() as u64;
    let result = input.by_ref().take(length).read_to_end(&mut start);
    result.map_err(unreadable)?;
    Ok(start)
}

fn unreadable(error: io::Error) -> TableError {
    csv::Error::from(error).into()
}

impl Records for TableRecords {
    type Record = csv::ByteRecord;

    fn header(&self) -> Result<Vec<String>, TableError> {
        self.0.header()
    }

    fn current(&self) -> &csv::ByteRecord {
        self.0.current()
    }

    fn advance(&mut self) -> Result<Option<RowPosition>, TableError> {
        self.0.advance()
    }

    fn checksum(&self) -> u32 {
        self.0.checksum()
    }

    fn consumed_bytes(&self) -> u64 {
        self.0.consumed_bytes()
    }
}
