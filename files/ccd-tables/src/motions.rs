//! Reads and writes the table of motions: CSV with one row for each query.

pub(crate) mod row;
#[cfg(test)]
mod tests;
mod write;

pub use super::error::{RowError, RowProblem, TableError};
pub use super::position::RowPosition;
pub use row::{BodyRow, body_row, parse_row};
pub use write::write;

use crate::columns::{Columns, TableKind};
use crate::csv_records::CsvRecords;
use crate::records::Records;
use ccd_core::Motion;
use rigid_ccd::Remark;
use std::io;

/// One row of a table of motions: the motions of two bodies over one duration.
#[derive(Clone, Debug, PartialEq)]
pub struct Motions {
    /// The id of the row in the results.
    pub id: String,
    /// The motion of body A, from time 0.
    pub a: Motion,
    /// The motion of body B, from time 0.
    pub b: Motion,
    /// The end of the motions, in their unit of time.
    pub duration: f64,
}

/// A table of motions, with its bad rows listed separately.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionTable {
    /// The valid rows.
    pub rows: Vec<(RowPosition, Motions)>,
    /// The errors of the other rows.
    pub errors: Vec<RowError>,
    /// The remarks about the rows, one of each kind.
    pub remarks: Vec<Remark>,
}

impl MotionTable {
    /// Reads a whole table; [`MotionRows`] reads it row by row.
    ///
    /// # Errors
    /// The errors of [`MotionRows`]. Bad rows are listed in [`MotionTable::errors`] instead.
    pub fn read(input: impl io::Read) -> Result<Self, TableError> {
        let mut table = MotionTable::default();
        let mut rows = MotionRows::new(input)?;
        for row in &mut rows {
            match row? {
                Ok(row) => table.rows.push(row),
                Err(error) => table.errors.push(error),
            }
        }
        table.remarks = rows.remarks();
        Ok(table)
    }
}

/// An iterator over the rows of a table of motions.
///
/// Columns are identified by their names, in any order. Missing columns have defaults: bodies at rest in the identity
/// pose, for a duration of 1. An empty cell has no default: it is an error of its row. But a row that gives the end
/// pose of a body leaves the velocities empty, and a row that gives velocities leaves the end pose empty. Lines may end
/// in `\n`, `\r\n` or `\r`. Empty lines are skipped, but counted. A quoted cell may hold line ends, and must be closed.
#[derive(Debug)]
pub struct MotionRows<S> {
    pub(crate) records: S,
    pub(crate) columns: Columns,
}

/// The motions of a valid row with its position, or the error of a bad row.
pub type MotionRow = Result<(RowPosition, Motions), RowError>;

impl<R: io::Read> MotionRows<CsvRecords<R>> {
    /// Creates the iterator, and reads the header of a CSV table.
    ///
    /// # Errors
    /// The header cannot be read, or has columns that cannot be used.
    pub fn new(input: R) -> Result<Self, TableError> {
        MotionRows::of(CsvRecords::new(input)?)
    }
}

impl<S: Records> MotionRows<S> {
    /// Creates the iterator over the rows of `records`.
    ///
    /// # Errors
    /// The header cannot be read, or has columns that cannot be used.
    pub fn of(records: S) -> Result<Self, TableError> {
        let columns = Columns::from_header(&records.header()?, TableKind::Motions)?;
        Ok(MotionRows { records, columns })
    }

    /// Skips rows without parsing them, and returns the number skipped.
    ///
    /// # Errors
    /// [`TableError::Unreadable`], [`TableError::UnclosedQuote`].
    pub fn skip_rows(&mut self, rows: usize) -> Result<usize, TableError> {
        for skipped in 0..rows {
            if self.records.advance()?.is_none() {
                return Ok(skipped);
            }
        }
        Ok(rows)
    }

    /// Returns the number of bytes of the input up to the end of the last row.
    pub fn consumed_bytes(&self) -> u64 {
        self.records.consumed_bytes()
    }

    /// Returns the remarks about the rows so far, one of each kind.
    pub fn remarks(&self) -> Vec<Remark> {
        self.columns.remarks()
    }

    /// Returns a checksum of the header and of all rows so far.
    pub fn checksum(&self) -> u32 {
        self.records.checksum()
    }
}

impl<S: Records> Iterator for MotionRows<S> {
    type Item = Result<MotionRow, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        let position = match self.records.advance() {
            Ok(position) => position?,
            Err(error) => return Some(Err(error)),
        };
        let raw = self.records.current();
        Some(Ok(match row::parse_row(&self.columns, raw, position.row) {
            Ok(motions) => Ok((position, motions)),
            Err(problem) => Err(RowError {
                position,
                id: row::id(&self.columns, raw).unwrap_or_else(|| position.row.to_string()),
                problem,
            }),
        }))
    }
}
