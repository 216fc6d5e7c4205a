//! Interfaces for tables of any format that are read as rows of cells.

use super::error::{RowProblem, TableError};
use super::position::RowPosition;

/// A table that is read row by row.
pub trait Records {
    /// The type of a row before parsing.
    type Record: Record;

    /// Returns the names of the columns; called before the first row is read.
    ///
    /// # Errors
    /// The names cannot be read.
    fn header(&self) -> Result<Vec<String>, TableError>;

    /// Returns the row that was read last.
    fn current(&self) -> &Self::Record;

    /// Reads the next row, and returns its position; `None` at the end.
    ///
    /// # Errors
    /// The table cannot be read further.
    fn advance(&mut self) -> Result<Option<RowPosition>, TableError>;

    /// Returns a checksum of the header and of all rows so far; 0 for tables that are in memory.
    fn checksum(&self) -> u32 {
        0
    }

    /// Returns the number of bytes of the input up to the end of the current record; 0 for tables that are in memory.
    fn consumed_bytes(&self) -> u64 {
        0
    }
}

/// A row of a table before parsing.
pub trait Record {
    /// Returns an error if the row and the header have different numbers of cells, or a cell is not text in UTF-8.
    ///
    /// # Errors
    /// The problem of the row.
    fn check(&self, _header: &[String]) -> Result<(), RowProblem> {
        Ok(())
    }

    /// Returns whether a cell is not empty.
    fn has_value(&self, cell: usize) -> bool;

    /// Returns the finite number in a cell; `None` if the cell is empty.
    ///
    /// # Errors
    /// The content of a cell that is no finite number.
    fn number(&self, cell: usize) -> Result<Option<f64>, String>;

    /// Returns the finite number in a cell, which is in the column of the given name.
    ///
    /// # Errors
    /// [`RowProblem::EmptyCell`], [`RowProblem::NotANumber`].
    fn required_number(&self, cell: usize, column: &str) -> Result<f64, RowProblem> {
        let column = || column.to_owned();
        match self.number(cell) {
            Ok(Some(number)) => Ok(number),
            Ok(None) => Err(RowProblem::EmptyCell { column: column() }),
            Err(value) => Err(RowProblem::NotANumber {
                column: column(),
                value,
            }),
        }
    }

    /// Returns the text of a cell, even if others are unreadable; `None` if it is empty.
    fn text(&self, cell: usize) -> Option<String>;
}
