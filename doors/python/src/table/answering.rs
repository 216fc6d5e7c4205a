//! Answers the rows of a table on all cores.

use super::batch::{id_field, unreadable_error};
use super::input::Reader;
use super::pieces::{ChunkSize, RowChunk, RowChunks, find_columns};
use super::results;
use arrow_array::RecordBatch;
use ccd_tables::batch::{BodyPair, TimedAnswer, parallel_solver};
use ccd_tables::columns::Columns;
use ccd_tables::motions::{RowProblem, TableError};
use ccd_tables::movements::{MovementRow, Movements};
use ccd_tables::results::ResultRow;
use rigid_ccd::Question;
use rigid_ccd::answer::Limit;
use rigid_ccd::{InputError, Remark, Settings, Solver};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Instant;

/// A question about each row of a table, with its settings.
#[derive(Clone, Copy)]
pub(crate) struct TableQuestion<'a> {
    pub(crate) bodies: BodyPair<'a>,
    pub(crate) question: Question,
    pub(crate) settings: &'a Settings,
    /// The number of threads; `None` stands for one on each core.
    pub(crate) thread_count: Option<u16>,
    /// Whether the results have a column with the time of each query.
    pub(crate) has_micros: bool,
}

/// The results of a table's rows up to the first row without an answer, and the error that ended the table, if any.
pub(crate) struct TableAnswers {
    pub(crate) results: RecordBatch,
    pub(crate) error: Option<TableError>,
    /// The remarks on probable mistakes in the rows.
    pub(crate) remarks: Vec<Remark>,
}

/// Answers the rows of a table on all threads, until the flag `stop` is set. Counts answered rows in `done`.
///
/// # Errors
/// The columns cannot be used.
pub(crate) fn answer(
    table_question: TableQuestion<'_>,
    reader: Reader,
    stop: &Arc<AtomicBool>,
    done: &AtomicUsize,
) -> Result<TableAnswers, TableError> {
    let columns = find_columns(&reader)?;
    let schema = results::schema(table_question.question, id_field(&reader.schema()));
    let schema = Arc::new(schema.map_err(unreadable_error)?);
    let settings = table_question.settings.clone().stopped_by(stop);
    let table_question = TableQuestion {
        settings: &settings,
        ..table_question
    };
    let mut solver = parallel_solver(table_question.thread_count, Solver::new);
    let (size, source) = (ChunkSize::new(solver.threads()), (reader, &columns));
    let mut chunks = RowChunks::new(source, table_question.question, &size, stop)?;
    let batches = solver.map_iter(chunks.by_ref(), |solver, chunk| {
        let start = Instant::now();
        let rows = answer_rows(table_question, &chunk, &columns, solver, stop);
        done.fetch_add(rows.len(), Ordering::Relaxed);
        size.adapt_chunk_size(chunk.row_count(), start.elapsed());
        let is_whole = rows.len() == chunk.row_count();
        let batch = results::batch(table_question.question, chunk.ids(rows.len()), &rows);
        batch.map(|batch| (batch, is_whole))
    });
    let batches: Vec<_> = batches
        .into_iter()
        .collect::<Result<_, _>>()
        .map_err(unreadable_error)?;
    // In a chunk that was stopped, the first rows have answers.
    let stopped = batches.iter().position(|&(_, is_whole)| !is_whole);
    let batch_count = stopped.map_or(batches.len(), |stopped| stopped + 1);
    let answered: Vec<RecordBatch> = batches
        .into_iter()
        .map(|(batch, _)| batch)
        .take(batch_count)
        .collect();
    Ok(TableAnswers {
        results: results::concatenate(&schema, &answered).map_err(unreadable_error)?,
        remarks: chunks.remarks(&columns),
        error: chunks.error,
    })
}

/// Answers the rows of one chunk of the table, until the flag `stop` is set.
///
/// Reads all rows first, then answers all, then makes all results. Done row by row, each of the three steps would start
/// with cold caches.
fn answer_rows(
    table_question: TableQuestion<'_>,
    chunk: &RowChunk,
    columns: &Columns,
    solver: &mut Solver,
    stop: &AtomicBool,
) -> Vec<ResultRow> {
    let rows: Vec<MovementRow> = chunk.read_rows(columns).collect();
    let answered: Vec<RowAnswer> = (rows.iter())
        .take_while(|_| !stop.load(Ordering::Relaxed))
        .map_while(|row| answer_row(table_question, row, solver))
        .collect();
    rows.iter()
        .zip(&answered)
        .map(|(row, answer)| result_row(table_question, row, answer))
        .collect()
}

/// The answer of a row, or the defect of the row.
type RowAnswer = Result<TimedAnswer, RowProblem>;

/// Answers one row. Returns `None` if the flag stopped the query.
fn answer_row(
    table_question: TableQuestion<'_>,
    row: &MovementRow,
    solver: &mut Solver,
) -> Option<RowAnswer> {
    let answer = match row {
        Ok((_, movements)) => {
            answer_timed(table_question, movements, solver).map_err(RowProblem::from)
        }
        Err(error) => Err(error.problem.clone()),
    };
    let is_stopped =
        matches!(&answer, Ok(timed) if timed.answer.outcome.limit() == Some(Limit::Stopped));
    (!is_stopped).then_some(answer)
}

fn answer_timed(
    table_question: TableQuestion<'_>,
    movements: &Movements,
    solver: &mut Solver,
) -> Result<TimedAnswer, InputError> {
    let start = Instant::now();
    let query = table_question.bodies.build_query(
        table_question.question,
        movements,
        table_question.settings,
    )?;
    let answer = solver.answer_query(table_question.question, &query)?;
    let micros = start.elapsed().as_secs_f64() * 1e6;
    Ok(TimedAnswer { answer, micros })
}

/// Returns the row of results from the answer or the error of one row of the table.
fn result_row(
    table_question: TableQuestion<'_>,
    row: &MovementRow,
    answer: &RowAnswer,
) -> ResultRow {
    let TableQuestion {
        bodies,
        question,
        settings,
        has_micros,
        ..
    } = table_question;
    let row = match row {
        Ok((_, movements)) => bodies.result_row(question, settings, movements, answer),
        Err(error) => ResultRow::error(&error.id, &error.problem),
    };
    ResultRow {
        micros: row.micros.filter(|_| has_micros),
        ..row
    }
}
