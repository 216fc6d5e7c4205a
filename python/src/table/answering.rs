//! The rows of a table, answered on all cores.

use super::batch::{Batch, Batches, Names, Row, Rows, check_types, header};
use super::input::Reader;
use super::results;
use arrow_array::{Array, ArrayRef, RecordBatch};
use arrow_schema::DataType;
use arrow_select::concat::concat_batches;
use rigid_ccd::batch::{BatchSize, Bodies, Question, Questions};
use rigid_ccd::table::courses::{Course, CourseRow, Courses};
use rigid_ccd::table::motions::{self, Columns, Form, RowError, RowProblem, TableError};
use rigid_ccd::table::results::ResultRow;
use rigid_ccd::{Config, Limit, ParallelSolver, Solver};
use std::collections::HashSet;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Instant;

/// What is asked about the rows of a table.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'a> {
    pub(crate) bodies: Bodies<'a>,
    pub(crate) question: Question,
    pub(crate) config: Config,
    /// What distances are compared with.
    pub(crate) clearance: Option<f64>,
    /// The number of threads; none for one on each core.
    pub(crate) threads: Option<NonZeroUsize>,
    pub(crate) micros: Micros,
}

/// Whether the time of each query is told.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Micros {
    Told,
    LeftOut,
}

/// Rows that one thread answers in one go.
enum Piece {
    Motions(Arc<Batch>, Range<usize>),
    /// A path, and its id.
    Path(Box<CourseRow>, ArrayRef),
}

/// The most rows that one thread answers in one go: results of many rows are made into columns faster.
const MOST_ROWS: usize = 64;

/// The pieces of a table, in order.
enum Pieces {
    Motions {
        batches: Batches,
        columns: Columns,
        /// What is left of the batch that was read last.
        rest: Option<(Arc<Batch>, Range<usize>)>,
    },
    Paths(Box<Courses<Rows>>, Arc<Batch>),
}

/// Answers the rows of a table until the flag is set. Counts them in `done` meanwhile.
///
/// Returns the results of the rows up to the first that was not answered.
pub(crate) fn answer(
    asked: Asked<'_>,
    reader: Reader,
    stop: &Arc<AtomicBool>,
    done: &AtomicUsize,
) -> Result<RecordBatch, TableError> {
    let schema = reader.schema();
    let id = schema.field_with_name("id");
    let id = id.map_or(DataType::Int64, |field| field.data_type().clone());
    let results = Arc::new(results::schema(asked.question, &id));
    let mut pieces = Pieces::of(reader, asked.question, Names::LeftOut)?;
    let create = || Solver::new().with_config(asked.config).with_stop(stop);
    let mut solver = match asked.threads {
        Some(threads) => ParallelSolver::with_threads(threads, create),
        None => ParallelSolver::new(create),
    };
    let mut size = BatchSize::new(solver.threads());
    let mut answered = Vec::new();
    loop {
        let round = pieces.take(size.items(), solver.threads())?;
        let start = Instant::now();
        let columns = pieces.columns();
        let found = solver.map(&round, |solver, piece| {
            let found = piece.answer(asked, columns, solver, stop);
            done.fetch_add(found.len(), Ordering::Relaxed);
            results::batch(asked.question, piece.ids(found.len()), &found)
        });
        size.adapt(start.elapsed());
        let whole = |(piece, found): (&Piece, &Result<RecordBatch, _>)| {
            found
                .as_ref()
                .is_ok_and(|found: &RecordBatch| found.num_rows() == piece.rows())
        };
        let ends = round.is_empty() || !round.iter().zip(&found).all(whole);
        let last = round.iter().zip(&found).position(|pair| !whole(pair));
        let found = found
            .into_iter()
            .take(last.map_or(usize::MAX, |last| last + 1));
        let found: Vec<RecordBatch> = found.collect::<Result<_, _>>().map_err(unreadable)?;
        answered.push(concat_batches(&results, &found).map_err(unreadable)?);
        if ends {
            return concat_batches(&results, &answered).map_err(unreadable);
        }
    }
}

/// Answers some rows of a table, by their numbers, one after another.
pub(crate) fn each(
    asked: Asked<'_>,
    reader: Reader,
    wanted: &HashSet<usize>,
    mut take: impl FnMut(&Course, &ResultRow),
) -> Result<(), TableError> {
    let mut pieces = Pieces::of(reader, asked.question, Names::Read)?;
    let mut solver = Solver::new().with_config(asked.config);
    let mut number = 0;
    loop {
        // One thread: pieces of one row each.
        let round = pieces.take(1, 1)?;
        let Some(piece) = round.first() else {
            return Ok(());
        };
        if wanted.contains(&number) {
            let row = piece.course(pieces.columns());
            if let (Some(Ok((_, course))), Some(result)) = (
                &row,
                row.as_ref().and_then(|row| result(asked, row, &mut solver)),
            ) {
                take(course, &result);
            }
        }
        number += 1;
    }
}

fn unreadable(error: arrow_schema::ArrowError) -> TableError {
    TableError::Unreadable(error.to_string())
}

impl Pieces {
    fn of(reader: Reader, question: Question, names: Names) -> Result<Self, TableError> {
        let schema = reader.schema();
        let columns = Columns::of(&header(&schema))?;
        check_types(&schema).map_err(TableError::Unreadable)?;
        Ok(match columns.form() {
            Form::Motions => Pieces::Motions {
                batches: Batches::new(reader, names),
                columns,
                rest: None,
            },
            Form::Paths => {
                let rows = Rows::of(reader)?;
                let batch = rows.batch();
                Pieces::Paths(Box::new(Courses::of(rows, question.grouping())?), batch)
            }
        })
    }

    fn columns(&self) -> Option<&Columns> {
        match self {
            Pieces::Motions { columns, .. } => Some(columns),
            Pieces::Paths(..) => None,
        }
    }

    /// Takes pieces of about `count` rows, some for each thread.
    fn take(&mut self, count: usize, threads: usize) -> Result<Vec<Piece>, TableError> {
        let mut pieces = Vec::new();
        match self {
            Pieces::Motions { batches, rest, .. } => {
                let most = (count / (8 * threads)).clamp(1, MOST_ROWS);
                let mut left = count;
                while left > 0 {
                    let Some((batch, rows)) = rest.take_if(|(_, rows)| rows.start < rows.end)
                    else {
                        match batches.next()? {
                            Some(batch) => {
                                let rows = 0..batch.rows;
                                *rest = Some((Arc::new(batch), rows));
                                continue;
                            }
                            None => break,
                        }
                    };
                    let end = (rows.start + most.min(left)).min(rows.end);
                    left -= end - rows.start;
                    pieces.push(Piece::Motions(Arc::clone(&batch), rows.start..end));
                    *rest = Some((batch, end..rows.end));
                }
            }
            Pieces::Paths(courses, batch) => {
                for row in courses.take(count) {
                    let row = row?;
                    let at = match &row {
                        Ok((position, _)) => position.row,
                        Err(error) => error.position.row,
                    };
                    pieces.push(Piece::Path(Box::new(row), batch.ids(at, 1)));
                }
            }
        }
        Ok(pieces)
    }
}

impl Piece {
    fn rows(&self) -> usize {
        match self {
            Piece::Motions(_, rows) => rows.len(),
            Piece::Path(..) => 1,
        }
    }

    /// Returns the ids of the first rows.
    fn ids(&self, rows: usize) -> ArrayRef {
        match self {
            Piece::Motions(batch, range) => batch.ids(range.start, rows),
            Piece::Path(_, id) => id.slice(0, rows),
        }
    }

    /// Reads the first row.
    fn course(&self, columns: Option<&Columns>) -> Option<CourseRow> {
        match self {
            Piece::Motions(batch, rows) => Some(course(batch, rows.start, columns?)),
            Piece::Path(row, _) => Some((**row).clone()),
        }
    }

    /// Answers the rows, up to the first that is stopped.
    fn answer(
        &self,
        asked: Asked<'_>,
        columns: Option<&Columns>,
        solver: &mut Solver,
        stop: &AtomicBool,
    ) -> Vec<ResultRow> {
        let mut answer = |row: &CourseRow| match stop.load(Ordering::Relaxed) {
            true => None,
            false => result(asked, row, solver),
        };
        match (self, columns) {
            (Piece::Motions(batch, rows), Some(columns)) => {
                let course = |at: usize| course(batch, at, columns);
                rows.clone().map_while(|at| answer(&course(at))).collect()
            }
            (Piece::Path(row, _), _) => answer(row).into_iter().collect(),
            (Piece::Motions(..), None) => Vec::new(),
        }
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

/// Answers a row; none where it is stopped.
fn result(asked: Asked<'_>, row: &CourseRow, solver: &mut Solver) -> Option<ResultRow> {
    let course = match row {
        Ok((_, course)) => course,
        Err(error) => return Some(ResultRow::error(&error.id, &error.problem)),
    };
    let start = Instant::now();
    let answer = match solver.ask(asked.question, asked.bodies, course, &asked.config) {
        Ok(answer) if answer.outcome.limit() == Some(Limit::Stopped) => return None,
        Ok(answer) => answer,
        Err(error) => return Some(ResultRow::error(course.id(), &RowProblem::from(error))),
    };
    let micros = start.elapsed().as_secs_f64() * 1e6;
    let row = ResultRow::new(course, &answer, micros, asked.clearance);
    Some(match asked.micros {
        Micros::Told => row,
        Micros::LeftOut => ResultRow {
            micros: None,
            ..row
        },
    })
}
