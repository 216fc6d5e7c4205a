//! Splits a table into chunks, each answered by one thread.

use super::batch::{
    Batch, IdReading, PathRowReader, Row, check_column_types, header, read_whole_table,
    unreadable_error,
};
use super::input::Reader;
use arrow_array::ArrayRef;
use ccd_tables::columns::Columns;
use ccd_tables::motions::{self, RowError, TableError};
use ccd_tables::movements::{MovementRow, MovementRows, Movements};
use ccd_tables::paths::Grouping;
use rigid_ccd::Question;
use rigid_ccd::Remark;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// The rows that a thread answers in one task.
pub(crate) enum RowChunk {
    /// Rows of a table of motions, as a range in a batch.
    Motions(Arc<Batch>, Range<usize>),
    /// A path and its id.
    Path(Box<MovementRow>, ArrayRef),
}

/// An iterator over the chunks of a table, in order, until the flag `stop` is set.
pub(crate) struct RowChunks<'p> {
    source: RowSource,
    chunk_size: &'p ChunkSize,
    stop: &'p AtomicBool,
    /// The error of the table that ended the iteration, if any.
    pub(crate) error: Option<TableError>,
}

enum RowSource {
    Motions {
        reader: Reader,
        /// The number of rows read so far.
        read_row_count: usize,
        /// The remaining rows of the last batch.
        rest: Option<(Arc<Batch>, Range<usize>)>,
    },
    Paths(Box<MovementRows<PathRowReader>>, Arc<Batch>),
}

/// The number of rows in a chunk, adapted to the time that chunks take.
///
/// Large chunks keep caches warm: with chunks of a quarter of the size, a table of bunnies takes 1.5 % more time.
/// Towards the end of a batch chunks get smaller, so that no thread waits long for the others.
pub(crate) struct ChunkSize {
    row_count: AtomicUsize,
    thread_count: usize,
}

/// The target time of a thread for one chunk of rows. Chunk sizes are adapted to it.
const TARGET_CHUNK_DURATION: Duration = Duration::from_millis(20);

/// The maximum number of rows in a chunk.
const MAX_CHUNK_ROWS: usize = 512;

impl ChunkSize {
    /// Creates the size for a number of threads. The first chunks have one row.
    pub(crate) fn new(threads: usize) -> Self {
        let rows = AtomicUsize::new(1);
        ChunkSize {
            row_count: rows,
            thread_count: threads,
        }
    }

    /// Returns the number of rows of the next chunk, if `remaining` rows remain.
    fn next_row_count(&self, remaining: usize) -> usize {
        let fraction = remaining.div_ceil(2 * self.thread_count);
        self.row_count.load(Ordering::Relaxed).min(fraction)
    }

    /// Adapts the size of later chunks to the time that a chunk of `rows` rows took.
    pub(crate) fn adapt_chunk_size(&self, rows: usize, duration: Duration) {
        // A small chunk at the end of a batch must not reduce the size of later chunks.
        if duration < TARGET_CHUNK_DURATION / 2 {
            self.row_count
                .fetch_max(MAX_CHUNK_ROWS.min(2 * rows), Ordering::Relaxed);
        } else if duration > 2 * TARGET_CHUNK_DURATION {
            self.row_count.store((rows / 2).max(1), Ordering::Relaxed);
        }
    }
}

/// Checks the columns of a table, and returns the index of each known column.
pub(crate) fn find_columns(reader: &Reader) -> Result<Columns, TableError> {
    let schema = reader.schema();
    let columns = Columns::of(&header(&schema))?;
    check_column_types(&schema).map_err(TableError::Unreadable)?;
    Ok(columns)
}

impl<'p> RowChunks<'p> {
    /// Creates the iterator over the chunks of a table with checked columns. Reads a table of paths to its end, or
    /// until the flag `stop` is set.
    pub(crate) fn new(
        (reader, columns): (Reader, &Columns),
        question: Question,
        size: &'p ChunkSize,
        stop: &'p AtomicBool,
    ) -> Result<Self, TableError> {
        let source = if columns.is_path_table() {
            let rows =
                PathRowReader::new(&read_whole_table(reader, stop).map_err(unreadable_error)?)?;
            let batch = rows.row_batch();
            RowSource::Paths(
                Box::new(MovementRows::of(rows, Grouping::of_question(question))?),
                batch,
            )
        } else {
            RowSource::Motions {
                reader,
                read_row_count: 0,
                rest: None,
            }
        };
        Ok(RowChunks {
            source,
            chunk_size: size,
            stop,
            error: None,
        })
    }
}

impl RowChunks<'_> {
    /// Returns the remarks about the rows read so far. `columns` collects the remarks about motions.
    pub(crate) fn remarks(&self, columns: &Columns) -> Vec<Remark> {
        match &self.source {
            RowSource::Motions { .. } => columns.remarks(),
            RowSource::Paths(movement_rows, _) => movement_rows.remarks(),
        }
    }
}

impl Iterator for RowChunks<'_> {
    type Item = RowChunk;

    fn next(&mut self) -> Option<RowChunk> {
        if self.stop.load(Ordering::Relaxed) || self.error.is_some() {
            return None;
        }
        let chunk = self.source.next(self.chunk_size);
        chunk.unwrap_or_else(|error| {
            self.error = Some(error);
            None
        })
    }
}

impl RowSource {
    /// Returns the next chunk, or `None` at the end. A chunk is empty only if its batch is.
    fn next(&mut self, size: &ChunkSize) -> Result<Option<RowChunk>, TableError> {
        match self {
            RowSource::Motions {
                reader,
                read_row_count: read,
                rest,
            } => {
                let (batch, rows) = match rest.take() {
                    Some((batch, rows)) if rows.start < rows.end => (batch, rows),
                    _ => {
                        let Some(batch) = reader.next().transpose().map_err(unreadable_error)?
                        else {
                            return Ok(None);
                        };
                        let batch = Batch::new(&batch, *read, IdReading::WithoutIds)?;
                        *read += batch.row_count;
                        let rows = 0..batch.row_count;
                        (Arc::new(batch), rows)
                    }
                };
                let end = rows.start + size.next_row_count(rows.len());
                *rest = Some((Arc::clone(&batch), end..rows.end));
                Ok(Some(RowChunk::Motions(batch, rows.start..end)))
            }
            RowSource::Paths(movement_rows, batch) => {
                let Some(row) = movement_rows.next().transpose()? else {
                    return Ok(None);
                };
                let position = match &row {
                    Ok((position, _)) => position,
                    Err(error) => &error.position,
                };
                let id = batch.ids(position.row, 1);
                Ok(Some(RowChunk::Path(Box::new(row), id)))
            }
        }
    }
}

impl RowChunk {
    /// Returns the number of rows or paths in the chunk.
    pub(crate) fn row_count(&self) -> usize {
        match self {
            RowChunk::Motions(_, rows) => rows.len(),
            RowChunk::Path(..) => 1,
        }
    }

    /// Returns the ids of the chunk's first `rows` rows.
    pub(crate) fn ids(&self, rows: usize) -> ArrayRef {
        match self {
            RowChunk::Motions(batch, range) => batch.ids(range.start, rows),
            RowChunk::Path(_, id) => id.slice(0, rows),
        }
    }

    /// Reads the rows of the chunk one after another.
    pub(crate) fn read_rows<'p>(
        &'p self,
        columns: &'p Columns,
    ) -> impl Iterator<Item = MovementRow> + 'p {
        (0..self.row_count()).map(move |k| match self {
            RowChunk::Motions(batch, rows) => read_row(batch, rows.start + k, columns),
            RowChunk::Path(row, _) => (**row).clone(),
        })
    }
}

/// Reads one row of a table of motions.
fn read_row(batch: &Arc<Batch>, at: usize, columns: &Columns) -> MovementRow {
    let row = batch.first + at;
    let position = motions::RowPosition { row, line: None };
    let record = Row {
        batch: Arc::clone(batch),
        row_index: at,
    };
    match motions::parse_row(columns, &record, row) {
        Ok(query) => Ok((position, Movements::Motions(query))),
        Err(problem) => Err(RowError {
            position,
            id: String::new(),
            problem,
        }),
    }
}
