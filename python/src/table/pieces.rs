//! A table in pieces, each for one thread.

use super::batch::{Batch, Batches, Names, Row, Rows, check_types, header, whole};
use super::input::Reader;
use arrow_array::ArrayRef;
use rigid_ccd::batch::Question;
use rigid_ccd::table::columns::{Columns, Form};
use rigid_ccd::table::courses::{Course, CourseRow, Courses};
use rigid_ccd::table::motions::{self, RowError, TableError};
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Rows that one thread answers in one go.
pub(crate) enum Piece {
    /// Rows of motions.
    Motions(Arc<Batch>, Range<usize>),
    /// A path, and its id.
    Path(Box<CourseRow>, ArrayRef),
}

/// The most rows that one thread answers in one go: results of many rows are made into columns faster.
const MOST_ROWS: usize = 64;

/// The pieces of a table, in order.
pub(crate) enum Pieces {
    Motions {
        batches: Batches,
        columns: Columns,
        /// What is left of the batch that was read last.
        rest: Option<(Arc<Batch>, Range<usize>)>,
    },
    Paths(Box<Courses<Rows>>, Arc<Batch>),
}

/// Some pieces of a table, and what went wrong after them.
pub(crate) type Taken = (Vec<Piece>, Option<TableError>);

/// Refuses a table by its columns.
pub(crate) fn check(reader: &Reader) -> Result<Columns, TableError> {
    let schema = reader.schema();
    let columns = Columns::of(&header(&schema))?;
    check_types(&schema).map_err(TableError::Unreadable)?;
    Ok(columns)
}

impl Pieces {
    /// Begins to read a table whose columns have been checked. One of paths is read to its end, or until the flag is set.
    pub(crate) fn of(
        (reader, columns): (Reader, Columns),
        question: Question,
        names: Names,
        stop: &AtomicBool,
    ) -> Result<Self, TableError> {
        Ok(match columns.form() {
            Form::Motions => Pieces::Motions {
                batches: Batches::new(reader, names),
                columns,
                rest: None,
            },
            Form::Paths => {
                let table = whole(reader, stop);
                let table = table.map_err(|error| TableError::Unreadable(error.to_string()))?;
                let rows = Rows::of(&table)?;
                let batch = rows.batch();
                Pieces::Paths(Box::new(Courses::of(rows, question.grouping())?), batch)
            }
        })
    }

    /// Takes pieces of about `count` rows, some for each thread, until the flag is set.
    pub(crate) fn take(&mut self, count: usize, threads: usize, stop: &AtomicBool) -> Taken {
        let mut pieces = Vec::new();
        let mut left = count;
        while left > 0 && !stop.load(Ordering::Relaxed) {
            match self.next((count / (8 * threads)).clamp(1, MOST_ROWS).min(left)) {
                Ok(Some(piece)) => {
                    left -= piece.rows();
                    pieces.push(piece);
                }
                Ok(None) => break,
                Err(error) => return (pieces, Some(error)),
            }
        }
        (pieces, None)
    }

    /// Returns a piece of up to `most` rows, at least one unless a batch has none.
    fn next(&mut self, most: usize) -> Result<Option<Piece>, TableError> {
        match self {
            Pieces::Motions { batches, rest, .. } => {
                let (batch, rows) = match rest.take() {
                    Some((batch, rows)) if rows.start < rows.end => (batch, rows),
                    _ => match batches.next()? {
                        Some(batch) => {
                            let rows = 0..batch.rows;
                            (Arc::new(batch), rows)
                        }
                        None => return Ok(None),
                    },
                };
                let end = (rows.start + most).min(rows.end);
                *rest = Some((Arc::clone(&batch), end..rows.end));
                Ok(Some(Piece::Motions(batch, rows.start..end)))
            }
            Pieces::Paths(courses, batch) => {
                let Some(row) = courses.next().transpose()? else {
                    return Ok(None);
                };
                let position = match &row {
                    Ok((position, _)) => position,
                    Err(error) => &error.position,
                };
                let id = batch.ids(position.row, 1);
                Ok(Some(Piece::Path(Box::new(row), id)))
            }
        }
    }

    /// The columns of a table of motions.
    pub(crate) fn columns(&self) -> Option<&Columns> {
        match self {
            Pieces::Motions { columns, .. } => Some(columns),
            Pieces::Paths(..) => None,
        }
    }
}

impl Piece {
    /// Returns the number of rows, or of paths.
    pub(crate) fn rows(&self) -> usize {
        match self {
            Piece::Motions(_, rows) => rows.len(),
            Piece::Path(..) => 1,
        }
    }

    /// Returns the ids of the first rows.
    pub(crate) fn ids(&self, rows: usize) -> ArrayRef {
        match self {
            Piece::Motions(batch, range) => batch.ids(range.start, rows),
            Piece::Path(_, id) => id.slice(0, rows),
        }
    }

    /// Reads the rows one after another.
    pub(crate) fn courses<'p>(
        &'p self,
        columns: Option<&'p Columns>,
    ) -> impl Iterator<Item = CourseRow> + 'p {
        (0..self.rows()).map_while(move |k| match self {
            Piece::Motions(batch, rows) => Some(course(batch, rows.start + k, columns?)),
            Piece::Path(row, _) => Some((**row).clone()),
        })
    }
}

/// Reads a row of motions.
fn course(batch: &Arc<Batch>, at: usize, columns: &Columns) -> CourseRow {
    let row = batch.first + at;
    let position = motions::RowPosition {
        row,
        line: row as u64,
    };
    let record = Row {
        batch: Arc::clone(batch),
        at,
    };
    match motions::query(columns, &record, row) {
        Ok(query) => Ok((position, Course::Motions(query))),
        Err(problem) => Err(RowError {
            position,
            id: String::new(),
            problem,
        }),
    }
}
