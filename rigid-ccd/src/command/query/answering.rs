//! Answers the rows of a query batch by batch, and writes them in order.

use super::args::QueryArgs;
use super::journal::Checkpoint;
use super::outputs::Outputs;
use super::summary::Summary;
use crate::ParallelSolver;
use crate::batch::{BatchSize, Bodies, Solve, Timed, Timing, time};
use crate::command::bad_rows::BadRows;
use crate::command::files::{Rows, input_name};
use crate::command::output::CannotWrite;
use crate::command::progress::Progress;
use crate::command::view::Chosen;
use crate::table::contacts;
use crate::table::courses::{Course, CourseRow};
use crate::table::motions::{RowError, RowPosition, TableError};
use crate::table::results::{self, Compared, ResultRow};
use anyhow::{Context, Result};
use std::time::Instant;

/// A run that answers rows batch by batch.
pub(super) struct Answering<'a> {
    pub(super) args: &'a QueryArgs,
    pub(super) bodies: Bodies<'a>,
    pub(super) timing: Timing,
    pub(super) solver: ParallelSolver<Box<dyn Solve>>,
    pub(super) batch: BatchSize,
    pub(super) outputs: Outputs,
    /// The rows for a page, if one was requested.
    pub(super) shown: Option<Chosen>,
    pub(super) summary: Summary,
    pub(super) bad_rows: BadRows,
    pub(super) progress: Progress,
}

impl Answering<'_> {
    /// Answers the selected rows from `start` on, and returns the last checkpoint.
    pub(super) fn answer_all(&mut self, rows: &mut Rows, start: Checkpoint) -> Result<Checkpoint> {
        let mut done = start;
        self.progress.answering(0, rows.bytes());
        loop {
            let end = self.args.rows.end;
            let remaining = end.map_or(usize::MAX, |end| end.saturating_sub(done.rows));
            let size = self.batch.items().min(remaining);
            let (batch, broken) = read_batch(rows, size);
            if batch.is_empty() && broken.is_none() {
                return Ok(done);
            }
            self.progress.answering(batch.len(), rows.bytes());
            self.answer(&batch)?;
            done = Checkpoint {
                rows: done.rows + batch.len(),
                checksum: rows.checksum(),
                bad: start.bad + self.bad_rows.count(),
                counts: self.summary.counts(),
                ..done
            };
            self.outputs.save(done)?;
            if let Some(error) = broken {
                return Err(error).with_context(|| input_name(&self.args.motions));
            }
        }
    }

    /// Answers a batch of rows, and writes their results and contacts.
    fn answer(&mut self, batch: &[CourseRow]) -> Result<(), CannotWrite> {
        let (bodies, timing, progress) = (self.bodies, &self.timing, &self.progress);
        let start = Instant::now();
        let answers = self.solver.map(batch, |solver, row| {
            let answer = match row {
                Ok((_, course)) => time(bodies, course, timing, solver.as_mut()),
                Err(error) => Err(error.problem.clone()),
            };
            progress.step();
            answer
        });
        self.batch.adapt(start.elapsed());
        let mut answered = Vec::new();
        for (batch, answer) in batch.iter().zip(&answers) {
            let (position, id) = match batch {
                Ok((position, course)) => (*position, course.id()),
                Err(error) => (error.position, error.id.as_str()),
            };
            let row = match (batch, answer) {
                (Ok((_, course)), Ok(timed)) => {
                    let row = self.result(course, timed);
                    self.summary.add(row.status, timed);
                    answered.push((position, course, timed));
                    row
                }
                (_, Err(problem)) | (Err(RowError { problem, .. }), _) => {
                    self.summary.add_error();
                    self.bad_rows.report(position, problem, &self.progress);
                    ResultRow::error(id, problem)
                }
            };
            if let (Some(shown), Ok((_, course))) = (&mut self.shown, batch) {
                shown.offer(course, &row);
            }
            let extent = self.args.extent();
            let results = &mut self.outputs.results;
            results.write(|writer| results::write(writer, extent, &row))?;
        }
        self.write_contacts(&answered)
    }

    /// Returns the row of results for an answer.
    fn result(&self, course: &Course, timed: &Timed) -> ResultRow {
        let Timed { answer, micros } = timed;
        let compared = Compared::of(self.bodies, self.args.clearance);
        let row = ResultRow::new(course, (self.timing.question, answer), *micros, compared);
        ResultRow {
            micros: row.micros.filter(|_| !self.args.no_micros),
            ..row
        }
    }

    /// Writes the contacts of the answered rows; a row with too many contacts counts as bad.
    fn write_contacts(
        &mut self,
        answered: &[(RowPosition, &Course, &Timed)],
    ) -> Result<(), CannotWrite> {
        let Some(table) = &mut self.outputs.contacts else {
            return Ok(());
        };
        let bodies = self.bodies;
        let Timing {
            question, settings, ..
        } = &self.timing;
        let question = *question;
        // A row may have very many contacts.
        for few in answered.chunks(ROWS_OF_CONTACTS) {
            let all = self.solver.map(few, |_, (_, course, timed)| {
                contacts::rows(bodies, course, settings, (question, &timed.answer))
            });
            for ((position, ..), rows) in few.iter().zip(all) {
                match rows {
                    Ok(rows) => {
                        for row in rows {
                            table.write(|writer| writer.serialize(row))?;
                        }
                    }
                    Err(error) => {
                        let problem = format!("contacts: {error}");
                        self.bad_rows.report(*position, &problem, &self.progress);
                    }
                }
            }
        }
        Ok(())
    }
}

/// The number of rows whose contacts are in memory at the same time.
const ROWS_OF_CONTACTS: usize = 64;

/// Reads up to `count` rows, and returns the error that ended the table early, if any.
fn read_batch(rows: &mut Rows, count: usize) -> (Vec<CourseRow>, Option<TableError>) {
    let mut batch = Vec::new();
    for row in rows.take(count) {
        match row {
            Ok(row) => batch.push(row),
            Err(error) => return (batch, Some(error)),
        }
    }
    (batch, None)
}
