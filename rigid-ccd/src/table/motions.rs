//! The table of motions: CSV in, motions of two bodies out, and back.

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

/// How two bodies move over one duration.
#[derive(Clone, Debug, PartialEq)]
pub struct Query {
    /// What the row is called in the results.
    pub id: String,
    /// Motion of body A.
    pub a: Motion,
    /// Motion of body B.
    pub b: Motion,
    /// How long, in the motions' unit of time.
    pub duration: f64,
}

/// Where in a table a row stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowPosition {
    /// Counted from 0 below the header, as `--rows` and the ids of rows without an id count.
    pub row: usize,
    /// The line of the file, counted from 1.
    pub line: u64,
}

/// A table of motions, its bad rows set aside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionTable {
    /// The rows that can be asked.
    pub rows: Vec<(RowPosition, Query)>,
    /// What is wrong with the others.
    pub errors: Vec<RowError>,
}

impl MotionTable {
    /// Reads a whole table, as [`MotionRows`] reads it row by row.
    ///
    /// # Errors
    /// Those of [`MotionRows`]; rows that cannot be asked are listed in [`MotionTable::errors`] instead.
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

/// The rows of a table of motions, one after the other: none is kept.
///
/// Columns go by name, in any order; those left out, and empty cells, have their defaults: rest at the
/// identity, for a duration of 1. [`known_columns`] lists them. Lines may end in `\n`, `\r\n` or `\r`;
/// empty ones are passed over, but counted. A quoted cell may hold ends of lines, and has to end.
#[derive(Debug)]
pub struct MotionRows<R> {
    reader: Reader<R>,
    columns: Columns,
    raw: csv::ByteRecord,
    /// How many rows have been read.
    rows: usize,
    checksum: crc32fast::Hasher,
}

/// A row that can be asked, or what is wrong with it.
pub type MotionRow = Result<(RowPosition, Query), RowError>;

impl<R: io::Read> MotionRows<R> {
    /// Reads the header.
    ///
    /// # Errors
    /// [`TableError`] when it cannot be read, or used.
    pub fn new(input: R) -> Result<Self, TableError> {
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .has_headers(false)
            // Every line has an end, the last one too, so that what has been read says where it began.
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

    /// Passes over rows without a look at what they hold; says how many there were.
    ///
    /// # Errors
    /// [`TableError::Unreadable`], [`TableError::UnclosedQuote`].
    pub fn pass(&mut self, rows: usize) -> Result<usize, TableError> {
        for passed in 0..rows {
            if self.advance()?.is_none() {
                return Ok(passed);
            }
        }
        Ok(rows)
    }

    /// How many bytes of the input have been read: with what is waiting to be looked at.
    pub fn bytes(&self) -> u64 {
        self.reader.get_ref().get_ref().0.input().bytes
    }

    /// A checksum of the header and of all rows so far.
    pub fn checksum(&self) -> u32 {
        self.checksum.clone().finalize()
    }

    /// Reads the next row; says where it stands.
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
        // Empty lines before the row have been read as well: its place is told from its end.
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

/// The line on which a quote opens that the record just read holds, and that nobody closes.
fn unclosed<R: io::Read>(reader: &Reader<R>) -> Option<u64> {
    let (quotes, _) = reader.get_ref().get_ref();
    quotes.unclosed(reader.position().line())
}

impl<R: io::Read> Iterator for MotionRows<R> {
    type Item = Result<MotionRow, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        let place = match self.advance() {
            Ok(place) => place?,
            Err(error) => return Some(Err(error)),
        };
        let query = row::query(&self.columns, &self.raw, place.row);
        Some(Ok(match query {
            Ok(query) => Ok((place, query)),
            Err(problem) => Err(RowError {
                place,
                id: row::id(&self.columns, &self.raw, place.row),
                problem,
            }),
        }))
    }
}

/// Every column that a table of motions may have.
pub fn known_columns() -> Vec<String> {
    columns::known()
}
