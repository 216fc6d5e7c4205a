//! Reads a CSV table record by record, with positions and a checksum.

use crate::error::{RowProblem, TableError};
use crate::foreign;
use crate::lines::LineEndConverter;
use crate::position::RowPosition;
use crate::records::{Record, Records};
use std::borrow::Cow;
use std::io::{self, Read};

/// A CSV table that is read record by record.
///
/// Lines may end in `\n`, `\r\n` or `\r`. Empty lines are skipped, but counted. A quoted cell may hold line
/// ends, and must be closed.
#[derive(Debug)]
pub struct CsvRecords<R> {
    reader: Reader<R>,
    raw_record: csv::ByteRecord,
    /// The number of records read, without the header.
    row_count: usize,
    checksum: crc32fast::Hasher,
}

type Reader<R> = csv::Reader<io::Chain<LineEndConverter<R>, &'static [u8]>>;

/// The greatest length in bytes of a record, with the empty lines before it.
const MAX_RECORD_BYTES: u64 = 1 << 24;

/// The greatest length in bytes of a cell.
const MAX_CELL_BYTES: usize = 1 << 16;

/// The line ends that are appended to the input. The first one ends the last row, because the line number of a row is
/// computed from its end. A row takes the second one only if a quote is still open.
const APPENDED_LINE_ENDS: &[u8] = b"\n\n";

impl<R: Read> CsvRecords<R> {
    /// Opens the table, and reads its header as the current record.
    ///
    /// # Errors
    /// [`TableError::Unreadable`], [`TableError::UnclosedQuote`].
    pub fn new(input: R) -> Result<Self, TableError> {
        let input = LineEndConverter::new(input).map_err(csv::Error::from)?;
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .has_headers(false)
            .from_reader(input.chain(APPENDED_LINE_ENDS));
        let mut raw_record = csv::ByteRecord::new();
        reader.get_mut().get_mut().0.allow_up_to(MAX_RECORD_BYTES);
        reader.read_byte_record(&mut raw_record)?;
        let mut records = CsvRecords {
            reader,
            raw_record,
            row_count: 0,
            checksum: crc32fast::Hasher::new(),
        };
        if let Some(line) = records.unclosed_quote_line() {
            return Err(TableError::UnclosedQuote { row: None, line });
        }
        add_record(&mut records.checksum, &records.raw_record);
        Ok(records)
    }

    /// Limits the length of the next record, with the empty lines before it. Without a limit, a device or a line without an end
    /// would fill the memory.
    fn allow_next_record(&mut self) {
        let end = self.reader.position().byte() + MAX_RECORD_BYTES;
        self.reader.get_mut().get_mut().0.allow_up_to(end);
    }

    /// Returns the line of a quote that the current record opens and does not close; `None` without one.
    fn unclosed_quote_line(&self) -> Option<u64> {
        let (input, _) = self.reader.get_ref().get_ref();
        let (end, last_cell) = (self.reader.position(), self.raw_record.iter().next_back()?);
        let is_open = end.byte() == input.output_byte_count() + APPENDED_LINE_ENDS.len() as u64;
        is_open.then(|| end.line() - line_end_count(last_cell))
    }
}

impl<R: Read> Records for CsvRecords<R> {
    type Record = csv::ByteRecord;

    fn header(&self) -> Result<Vec<String>, TableError> {
        if cfg!(not(feature = "parquet")) && foreign::is_parquet(&self.raw_record) {
            return Err(TableError::ParquetNotBuilt);
        }
        if let Some(format) = foreign::format(&self.raw_record) {
            return Err(TableError::NotCsv {
                other_format: format,
            });
        }
        if foreign::is_lfs_pointer(&self.raw_record) {
            return Err(TableError::LfsPointer);
        }
        match csv::StringRecord::from_byte_record(self.raw_record.clone()) {
            Ok(header) => Ok(header.iter().map(|name| name.trim().to_owned()).collect()),
            Err(_) => Err(TableError::HeaderNotText),
        }
    }

    fn current(&self) -> &csv::ByteRecord {
        &self.raw_record
    }

    fn consumed_bytes(&self) -> u64 {
        let (input, _) = self.reader.get_ref().get_ref();
        input.input_bytes_for_output(self.reader.position().byte())
    }

    fn checksum(&self) -> u32 {
        self.checksum.clone().finalize()
    }

    fn advance(&mut self) -> Result<Option<RowPosition>, TableError> {
        let line_before = self.reader.position().line();
        self.allow_next_record();
        if !self.reader.read_byte_record(&mut self.raw_record)? {
            return Ok(None);
        }
        if let Some(line) = self.unclosed_quote_line() {
            let row = Some(self.row_count);
            return Err(TableError::UnclosedQuote { row, line });
        }
        add_record(&mut self.checksum, &self.raw_record);
        let row = self.row_count;
        self.row_count += 1;
        // The reader also skips empty lines before the row, so the line number is computed from the row's
        // end.
        let inner_line_ends: u64 = self.raw_record.iter().map(line_end_count).sum();
        let line_after = self.reader.position().line();
        Ok(Some(RowPosition {
            row,
            line: Some(
                line_after
                    .saturating_sub(inner_line_ends + 1)
                    .max(line_before),
            ),
        }))
    }
}

impl Record for csv::ByteRecord {
    fn check(&self, header: &[String]) -> Result<(), RowProblem> {
        if self.len() != header.len() {
            return Err(RowProblem::WrongCellCount {
                cells: self.len(),
                column_count: header.len(),
            });
        }
        for (cell, column) in self.iter().zip(header) {
            if cell.len() > MAX_CELL_BYTES {
                return Err(RowProblem::CellTooLong {
                    column: column.clone(),
                    bytes: cell.len(),
                    most: MAX_CELL_BYTES,
                });
            }
            if str::from_utf8(cell).is_err() {
                let column = column.clone();
                return Err(RowProblem::NotText { column });
            }
        }
        Ok(())
    }

    fn has_value(&self, cell: usize) -> bool {
        !trimmed_cell(self, cell).is_empty()
    }

    fn number(&self, cell: usize) -> Result<Option<f64>, String> {
        match trimmed_cell(self, cell) {
            text if text.is_empty() => Ok(None),
            text => match text.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(Some(value)),
                _ => Err(text.into_owned()),
            },
        }
    }

    fn text(&self, cell: usize) -> Option<String> {
        let text = trimmed_cell(self, cell);
        (!text.is_empty()).then(|| text.into_owned())
    }
}

/// Returns the text of a cell without the spaces around it.
fn trimmed_cell(record: &csv::ByteRecord, cell: usize) -> Cow<'_, str> {
    let text = String::from_utf8_lossy(record.get(cell).unwrap_or_default());
    match text {
        Cow::Borrowed(text) => text.trim().into(),
        Cow::Owned(text) => text.trim().to_owned().into(),
    }
}

/// Adds the cells of a record, and the length of each cell, to a checksum.
pub(super) fn add_record(checksum: &mut crc32fast::Hasher, record: &csv::ByteRecord) {
    checksum.update(record.as_slice());
    for cell in record {
        checksum.update(&(cell.len() as u64).to_le_bytes());
    }
}

fn line_end_count(cell: &[u8]) -> u64 {
    cell.iter().filter(|&&byte| byte == b'\n').count() as u64
}

#[cfg(test)]
mod tests;
