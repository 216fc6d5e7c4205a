//! Answers the rows of a table batch by batch, on all cores: for `ccd query` and `ccd audit`.

use super::bad_rows::BadRows;
use super::files::{Rows, input_name};
use super::progress::Progress;
use crate::ParallelSolver;
use crate::batch::{BatchSize, Bodies, Solve, Timed, Timing, answer, on_threads};
use crate::table::courses::{Course, CourseRow};
use crate::table::motions::{RowPosition, TableError};
use crate::table::results::{ResultRow, Status};
use std::path::Path;
use std::time::Instant;

/// A run that answers rows.
pub(super) struct Answering<'a> {
    pub(super) bodies: Bodies<'a>,
    pub(super) timing: Timing,
    pub(super) solver: ParallelSolver<Box<dyn Solve>>,
    batch: BatchSize,
    pub(super) bad_rows: BadRows,
    pub(super) progress: Progress,
}

/// A row of a table and its row of results.
pub(super) struct Answered {
    pub(super) position: RowPosition,
    /// The motions or paths; `None` for a row that cannot be read.
    pub(super) course: Option<Course>,
    pub(super) row: ResultRow,
    /// The answer; `None` for an error.
    pub(super) timed: Option<Timed>,
}

impl<'a> Answering<'a> {
    /// Starts a run over the table of a file, with one solver for each of `threads`.
    pub(super) fn new(
        bodies: Bodies<'a>,
        timing: Timing,
        threads: Option<u16>,
        motions: &Path,
        progress: Progress,
    ) -> Self {
        let solver = on_threads(threads, || {
            timing.method.solver(timing.settings.instructions)
        });
        Answering {
            bodies,
            batch: BatchSize::new(solver.threads()),
            timing,
            solver,
            bad_rows: BadRows::new(input_name(motions)),
            progress,
        }
    }

    /// Reads some rows, but no more than `most`, and answers them. The error is the one that ended the table early.
    pub(super) fn next(
        &mut self,
        rows: &mut Rows,
        most: usize,
    ) -> (Vec<Answered>, Option<TableError>) {
        let (batch, broken) = read(rows, self.batch.items().min(most));
        self.progress.answering(batch.len(), rows.bytes());
        let (bodies, timing, progress) = (self.bodies, &self.timing, &self.progress);
        let start = Instant::now();
        let answers = self.solver.map(&batch, |solver, row| {
            let answered = match row {
                Ok((_, course)) => answer(bodies, course, timing, solver.as_mut()),
                Err(error) => (ResultRow::error(&error.id, &error.problem), None),
            };
            progress.step();
            answered
        });
        self.batch.adapt(start.elapsed());
        let answered = batch.into_iter().zip(answers);
        let answered = answered.map(|(asked, (row, timed))| {
            let (position, course) = match asked {
                Ok((position, course)) => (position, Some(course)),
                Err(error) => (error.position, None),
            };
            if let (Status::Error, Some(reason)) = (row.status, &row.reason) {
                self.bad_rows.report(position, reason, &self.progress);
            }
            Answered {
                position,
                course,
                row,
                timed,
            }
        });
        (answered.collect(), broken)
    }
}

/// Reads up to `count` rows, and returns the error that ended the table early, if any.
fn read(rows: &mut Rows, count: usize) -> (Vec<CourseRow>, Option<TableError>) {
    let mut batch = Vec::new();
    for row in rows.take(count) {
        match row {
            Ok(row) => batch.push(row),
            Err(error) => return (batch, Some(error)),
        }
    }
    (batch, None)
}
