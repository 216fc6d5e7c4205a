//! The table of motions: CSV read as motions of two bodies, and written.

mod columns;
mod error;
mod foreign;
mod row;
#[cfg(test)]
mod tests;
mod write;

pub use error::{RowError, RowProblem, TableError};
pub use write::write;

use crate::table::lines::Lines;
use crate::table::quotes::Quotes;
use ccd_core::Motion;
use columns::Columns;
use std::io::{self, Read};

/// The motions of two bodies over one duration.
#[derive(Clone, Debug, PartialEq)]
pub struct Query {
    /// The id of the row in the results.
    pub id: String,
    /// The motion of body A.
    pub a: Motion,
    /// The motion of body B.
    pub b: Motion,
    /// The end of the motions, in their unit of time.
    pub duration: f64,
}

/// The position of a row in a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowPosition {
    /// The number of the row, counted from 0 after the header, as `--rows` counts.
    pub row: usize,
    /// The line of the file, counted from 1.
    pub line: u64,
}

/// A table of motions, with its bad rows listed separately.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionTable {
    /// The valid rows.
    pub rows: Vec<(RowPosition, Query)>,
    /// The errors of the other rows.
    pub errors: Vec<RowError>,
}

impl MotionTable {
    /// Reads a whole table; [`MotionRows`] reads it row by row.
    ///
    /// # Errors
    /// The errors of [`MotionRows`]. Bad rows are listed in [`MotionTable::errors`] instead.
    pub fn read(input: impl io::Read) -> Result<Self, TableError> {
        let mut table = MotionTable::default();
        for row in MotionRows::new(input)? {
            match row? {
                Ok(row) => table.rows.push(row),
                Err(error) => table.errors.push(error),
            }
        }
        Ok(table)
    }
}

/// An iterator over the rows of a table of motions.
///
/// Columns go by name, in any order. Missing columns and empty cells have defaults: at rest at the
/// identity, for a duration of 1. Lines may end in `\n`, `\r\n` or `\r`. Empty lines are skipped, but
/// counted. A quoted cell may hold line ends, and must be closed.
#[derive(Debug)]
pub struct MotionRows<R> {
    reader: Reader<R>,
    columns: Columns,
    raw: csv::ByteRecord,
    /// The number of rows read.
    rows: usize,
    checksum: crc32fast::Hasher,
}

/// A valid row, or the error of a bad one.
pub type MotionRow = Result<(RowPosition, Query), RowError>;

impl<R: io::Read> MotionRows<R> {
    /// Reads the header.
    ///
    /// # Errors
    /// The header cannot be read, or has columns that cannot be used.
    pub fn new(input: R) -> Result<Self, TableError> {
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .has_headers(false)
            // Every line needs an end, the last one too: the line of a row is computed from its end.
            .from_reader(Quotes::new(Lines::new(input)).chain(&b"\n"[..]));
        let mut raw = csv::ByteRecord::new();
        reader.read_byte_record(&mut raw)?;
        if let Some(line) = unclosed(&reader) {
            return Err(TableError::UnclosedQuote { row: None, line });
        }
        let columns = Columns::from_header(&raw)?;
        let mut checksum = crc32fast::Hasher::new();
        checksum.update(raw.as_slice());
        Ok(MotionRows {
            reader,
            columns,
            raw,
            rows: 0,
            checksum,
        })
    }

    /// Skips rows without parsing them, and returns the number skipped.
    ///
    /// # Errors
    /// [`TableError::Unreadable`], [`TableError::UnclosedQuote`].
    pub fn skip_rows(&mut self, rows: usize) -> Result<usize, TableError> {
        for skipped in 0..rows {
            if self.advance()?.is_none() {
                return Ok(skipped);
            }
        }
        Ok(rows)
    }

    /// Returns the number of bytes read from the input, with those that wait in a buffer.
    pub fn bytes(&self) -> u64 {
        self.reader.get_ref().get_ref().0.input().bytes
    }

    /// Returns a checksum of the header and of all rows so far.
    pub fn checksum(&self) -> u32 {
        self.checksum.clone().finalize()
    }

    /// Reads the next row, and returns its position.
    fn advance(&mut self) -> Result<Option<RowPosition>, TableError> {
        let before = self.reader.position().line();
        if !self.reader.read_byte_record(&mut self.raw)? {
            return Ok(None);
        }
        if let Some(line) = unclosed(&self.reader) {
            let row = Some(self.rows);
            return Err(TableError::UnclosedQuote { row, line });
        }
        self.checksum.update(self.raw.as_slice());
        let row = self.rows;
        self.rows += 1;
        // Empty lines before the row have been read as well: its line is computed from its end.
        let ends = |cell: &[u8]| cell.iter().filter(|&&byte| byte == b'\n').count() as u64;
        let within: u64 = self.raw.iter().map(ends).sum();
        let after = self.reader.position().line();
        Ok(Some(RowPosition {
            row,
            line: after.saturating_sub(within + 1).max(before),
        }))
    }
}

type Reader<R> = csv::Reader<io::Chain<Quotes<Lines<R>>, &'static [u8]>>;

/// Returns the line of an unclosed quote in the record that was read last.
fn unclosed<R: io::Read>(reader: &Reader<R>) -> Option<u64> {
    let (quotes, _) = reader.get_ref().get_ref();
    quotes.unclosed(reader.position().line())
}

impl<R: io::Read> Iterator for MotionRows<R> {
    type Item = Result<MotionRow, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        let position = match self.advance() {
            Ok(position) => position?,
            Err(error) => return Some(Err(error)),
        };
        let query = row::query(&self.columns, &self.raw, position.row);
        Some(Ok(match query {
            Ok(query) => Ok((position, query)),
            Err(problem) => Err(RowError {
                position,
                id: row::id(&self.columns, &self.raw, position.row),
                problem,
            }),
        }))
    }
}
