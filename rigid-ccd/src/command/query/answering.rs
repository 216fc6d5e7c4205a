//! Answers the rows of a table batch by batch, on all cores.

use crate::ParallelSolver;
use crate::batch::{
    BatchSize, Bodies, Solve, TimedAnswer, TimedQuestion, answer_timed, parallel_solver,
};
use crate::command::bad_rows::BadRowCounter;
use crate::command::files::{Rows, input_name};
use crate::command::progress::Progress;
use crate::table::courses::{CourseRow, Movements};
use crate::table::motions::{RowPosition, RowProblem, TableError};
use crate::table::results::ResultRow;
use std::path::Path;
use std::time::Instant;

/// The state of a command that answers the rows of a table in batches.
pub(super) struct BatchRun<'a> {
    pub(super) bodies: Bodies<'a>,
    pub(super) timed_question: TimedQuestion,
    pub(super) solver: ParallelSolver<Box<dyn Solve>>,
    batch: BatchSize,
    pub(super) bad_row_counter: BadRowCounter,
    pub(super) progress: Progress,
}

/// Consecutive rows with their answers, and the error that ended the table after them, if any.
pub(super) struct Batch {
    pub(super) rows: Vec<(CourseRow, Result<TimedAnswer, RowProblem>)>,
    pub(super) table_error: Option<TableError>,
}

/// One row of the input table, with its row in the table of results.
pub(super) struct AnsweredRow<'b> {
    pub(super) position: RowPosition,
    /// The motions or paths of the row; `None` for a row that cannot be read.
    pub(super) movements: Option<&'b Movements>,
    pub(super) row: ResultRow,
    /// The answer with its duration; `None` for a row with an error.
    pub(super) timed_answer: Option<&'b TimedAnswer>,
}

impl<'a> BatchRun<'a> {
    /// Creates the state for the table in a file, with one solver for each of `threads` threads; `None` means each
    /// core.
    pub(super) fn new(
        bodies: Bodies<'a>,
        timing: TimedQuestion,
        threads: Option<u16>,
        motions: &Path,
        progress: Progress,
    ) -> Self {
        let solver = parallel_solver(threads, || {
            timing.method.solver(timing.settings.vector_instructions)
        });
        BatchRun {
            bodies,
            batch: BatchSize::new(solver.threads()),
            timed_question: timing,
            solver,
            bad_row_counter: BadRowCounter::new(input_name(motions)),
            progress,
        }
    }

    /// Reads and answers the next batch of at most `most` rows; `None` at the end of the table.
    pub(super) fn next(&mut self, rows: &mut Rows, most: usize) -> Option<Batch> {
        let (batch, broken) = read_rows(rows, self.batch.row_count().min(most));
        if batch.is_empty() && broken.is_none() {
            return None;
        }
        self.progress
            .begin_batch(batch.len(), rows.consumed_bytes());
        let (bodies, timing, progress) = (self.bodies, &self.timed_question, &self.progress);
        let start = Instant::now();
        let answers = self.solver.map(&batch, |solver, row| {
            let answer = match row {
                Ok((_, course)) => answer_timed(bodies, course, timing, solver.as_mut()),
                Err(error) => Err(error.problem.clone()),
            };
            progress.step();
            answer
        });
        self.batch.adapt(start.elapsed());
        let rows = batch.into_iter().zip(answers).collect();
        Some(Batch {
            rows,
            table_error: broken,
        })
    }

    /// Returns the row of results for a row of motions, and reports the row if it is bad.
    pub(super) fn report_and_convert_row<'b>(
        &mut self,
        (asked, answer): &'b (CourseRow, Result<TimedAnswer, RowProblem>),
    ) -> AnsweredRow<'b> {
        let (position, course, row) = match asked {
            Ok((position, course)) => {
                let row = self.timed_question.row(self.bodies, course, answer);
                (*position, Some(course), row)
            }
            Err(error) => {
                let row = ResultRow::error(&error.id, &error.problem);
                (error.position, None, row)
            }
        };
        if let Err(problem) = answer {
            self.bad_row_counter
                .report(position, problem, &self.progress);
        }
        AnsweredRow {
            position,
            movements: course,
            row,
            timed_answer: answer.as_ref().ok(),
        }
    }
}

/// Reads up to `count` rows, and returns the error that ended the table early, if any.
fn read_rows(rows: &mut Rows, count: usize) -> (Vec<CourseRow>, Option<TableError>) {
    let mut batch = Vec::new();
    for row in rows.take(count) {
        match row {
            Ok(row) => batch.push(row),
            Err(error) => return (batch, Some(error)),
        }
    }
    (batch, None)
}
