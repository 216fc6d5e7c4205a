//! Answers the selected rows of a query, and writes them in order.

use super::answering::{AnsweredRow, Batch, BatchRun};
use super::args::QueryArgs;
use super::journal::Checkpoint;
use super::outputs::Outputs;
use super::summary::Summary;
use crate::batch::{TimedAnswer, TimedQuestion};
use crate::command::files::{Rows, input_name};
use crate::command::output::OutputError;
use crate::command::view::ChosenRows;
use crate::table::contacts;
use crate::table::courses::Movements;
use crate::table::motions::RowPosition;
use crate::table::results::Line;
use anyhow::{Context, Result};

/// The state of `ccd query` while it answers rows.
pub(super) struct QueryRun<'a> {
    pub(super) args: &'a QueryArgs,
    pub(super) batch_run: BatchRun<'a>,
    pub(super) outputs: Outputs,
    /// The rows chosen for the page of `--html`; `None` without this option.
    pub(super) page_rows: Option<ChosenRows>,
    pub(super) summary: Summary,
}

impl QueryRun<'_> {
    /// Answers the selected rows from `start` on, and returns the last checkpoint.
    pub(super) fn answer_rows(&mut self, rows: &mut Rows, start: Checkpoint) -> Result<Checkpoint> {
        let mut done = start;
        self.batch_run
            .progress
            .begin_batch(0, rows.consumed_bytes());
        loop {
            let end = self.args.rows.end;
            let remaining = end.map_or(usize::MAX, |end| end.saturating_sub(done.rows));
            let Some(batch) = self.batch_run.next(rows, remaining) else {
                return Ok(done);
            };
            self.write(&batch)?;
            done = Checkpoint {
                rows: done.rows + batch.rows.len(),
                checksum: rows.checksum(),
                bad_rows: start.bad_rows + self.batch_run.bad_row_counter.count(),
                counts: self.summary.counts,
                ..done
            };
            self.outputs.save(done)?;
            if let Some(error) = batch.table_error {
                return Err(error).with_context(|| input_name(&self.args.motions));
            }
        }
    }

    /// Writes the results and contacts of a batch of answered rows.
    fn write(&mut self, batch: &Batch) -> Result<(), OutputError> {
        let (columns, mut all) = (self.args.columns(), Vec::new());
        for row in &batch.rows {
            let AnsweredRow {
                position,
                movements: course,
                mut row,
                timed_answer: timed,
            } = self.batch_run.report_and_convert_row(row);
            match timed {
                Some(timed) => self.summary.add(row.status, timed),
                None => self.summary.add_error(),
            }
            row.micros = row.micros.filter(|_| !self.args.no_micros);
            if let (Some(shown), Some(course)) = (&mut self.page_rows, course) {
                shown.add_if_wanted(course, &row);
            }
            self.outputs.results.row(&Line(&columns, &row))?;
            all.extend(
                course
                    .zip(timed)
                    .map(|(course, timed)| (position, course, timed)),
            );
        }
        self.find_and_write_contacts(&all)
    }

    /// Writes the contacts of the answered rows; a row with too many contacts counts as bad.
    fn find_and_write_contacts(
        &mut self,
        answered: &[(RowPosition, &Movements, &TimedAnswer)],
    ) -> Result<(), OutputError> {
        let Some(table) = &mut self.outputs.contacts else {
            return Ok(());
        };
        let BatchRun {
            bodies,
            timed_question: timing,
            solver,
            bad_row_counter: bad_rows,
            progress,
            ..
        } = &mut self.batch_run;
        let (bodies, columns) = (*bodies, contacts::columns());
        let TimedQuestion {
            question, settings, ..
        } = timing;
        let question = *question;
        // A row may have very many contacts.
        for few in answered.chunks(CONTACT_BATCH_ROWS) {
            let all = solver.map(few, |_, (_, course, timed)| {
                contacts::contact_rows(bodies, course, settings, (question, &timed.answer))
            });
            for ((position, ..), rows) in few.iter().zip(all) {
                match rows {
                    Ok(rows) => {
                        for row in rows {
                            table.row(&Line(&columns, &row))?;
                        }
                    }
                    Err(error) => {
                        let problem = format!("contacts: {error}");
                        bad_rows.report(*position, &problem, progress);
                    }
                }
            }
        }
        Ok(())
    }
}

/// The number of rows whose contacts are in memory at the same time.
const CONTACT_BATCH_ROWS: usize = 64;
