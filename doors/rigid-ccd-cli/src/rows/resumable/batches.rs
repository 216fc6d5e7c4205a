//! Reads the rows of a table in batches, and saves a checkpoint after each batch.

use super::journal::Checkpoint;
use super::run_files::RunFiles;
use crate::files::output::OutputError;
use crate::files::{Rows, input_name};
use crate::rows::counts::StatusCounts;
use anyhow::{Context, Result};
use ccd_tables::motions::TableError;
use ccd_tables::movements::{MovementRow, MovementRows};

/// A table of queries, read row by row.
pub(crate) trait RowSource: Iterator<Item = Result<Self::Row, TableError>> {
    /// A parsed row: a query, or the reason why it is invalid.
    type Row;

    /// Skips rows, and returns how many there were.
    ///
    /// # Errors
    /// The table cannot be read.
    fn skip_rows(&mut self, count: usize) -> Result<usize, TableError>;

    /// Returns the checksum of the table up to the last row that was read.
    fn checksum(&self) -> u32;

    /// Returns the number of bytes of the input up to the last row that was read.
    fn consumed_bytes(&self) -> u64;
}

impl RowSource for Rows {
    type Row = MovementRow;

    fn skip_rows(&mut self, count: usize) -> Result<usize, TableError> {
        MovementRows::skip_rows(self, count)
    }

    fn checksum(&self) -> u32 {
        MovementRows::checksum(self)
    }

    fn consumed_bytes(&self) -> u64 {
        MovementRows::consumed_bytes(self)
    }
}

/// A run that answers rows batch by batch.
pub(crate) trait Batches<R> {
    /// Returns the number of rows of the next batch.
    fn row_count(&self) -> usize;

    /// Prepares for a batch of rows, which end at a byte of the input.
    fn begin(&mut self, row_count: usize, end_byte: u64);

    /// Answers the rows, and writes the answers.
    ///
    /// # Errors
    /// The answers cannot be written.
    fn answer_and_write(&mut self, rows: &[R]) -> Result<(), OutputError>;

    /// Returns the number of rows so far that could not be answered, and the number of rows of each status.
    fn counts(&self) -> (usize, StatusCounts);

    /// Saves the answers, with the state of the run.
    ///
    /// # Errors
    /// They cannot be written.
    fn save(&mut self, checkpoint: Checkpoint) -> Result<(), OutputError>;
}

/// Answers the selected rows from a checkpoint on, and returns the last checkpoint.
pub(crate) fn answer_in_batches<S: RowSource>(
    files: &RunFiles<'_>,
    source: &mut S,
    start: Checkpoint,
    run: &mut impl Batches<S::Row>,
) -> Result<Checkpoint> {
    let mut done = start;
    run.begin(0, source.consumed_bytes());
    loop {
        let end = files.rows.end_row;
        let remaining = end.map_or(usize::MAX, |end| end.saturating_sub(done.rows));
        let (batch, table_error) = read_rows(source, run.row_count().min(remaining));
        if batch.is_empty() && table_error.is_none() {
            return Ok(done);
        }
        run.begin(batch.len(), source.consumed_bytes());
        run.answer_and_write(&batch)?;
        let (bad_rows, counts) = run.counts();
        done = Checkpoint {
            rows: done.rows + batch.len(),
            checksum: source.checksum(),
            bad_rows: start.bad_rows + bad_rows,
            counts,
            ..done
        };
        run.save(done)?;
        if let Some(error) = table_error {
            return Err(error).with_context(|| input_name(files.input));
        }
    }
}

/// Reads up to `count` rows, and returns the error that ended the table early, if any.
fn read_rows<S: RowSource>(source: &mut S, count: usize) -> (Vec<S::Row>, Option<TableError>) {
    let mut table_error = None;
    let rows = source
        .take(count)
        .map_while(|row| row.map_err(|error| table_error = Some(error)).ok());
    (rows.collect(), table_error)
}
