//! The position of a row in a table, for messages.

use std::fmt;

/// The position of a row in a table: its number among the rows, and its line in a file of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowPosition {
    /// The number of the row, counted from 0 after the header, as `--rows` counts.
    pub row: usize,
    /// The line of the file, counted from 1; `None` in a table without lines.
    pub line: Option<u64>,
}

impl fmt::Display for RowPosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RowPosition { row, line } = self;
        write!(f, "row {row}")?;
        line.map_or(Ok(()), |line| write!(f, " (line {line})"))
    }
}
