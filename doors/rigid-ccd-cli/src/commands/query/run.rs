//! Answers the selected rows of a query, and writes them in order.

use super::args::QueryArgs;
use super::summary::Summary;
use crate::commands::view::ChosenRows;
use crate::console::progress::Progress;
use crate::files::output::OutputError;
use crate::options::solver_kind::Solve;
use crate::rows::bad_rows::BadRowCounter;
use crate::rows::certificates::PairCertificates;
use crate::rows::contacts;
use crate::rows::counts::StatusCounts;
use crate::rows::resumable::{Batches, Checkpoint, Outputs};
use crate::rows::timed::{TimedQuestion, answer_timed};
use ccd_tables::batch::{BatchSize, BodyPair, TimedAnswer};
use ccd_tables::motions::{RowPosition, RowProblem};
use ccd_tables::movements::{MovementRow, Movements};
use ccd_tables::results::{Line, ResultRow, Status};
use rigid_ccd::ParallelSolver;
use std::time::Instant;

/// The state of `ccd query` while it answers rows.
pub(super) struct QueryRun<'a> {
    pub(super) args: &'a QueryArgs,
    pub(super) bodies: BodyPair<'a>,
    pub(super) timed_question: TimedQuestion,
    pub(super) solver: ParallelSolver<Box<dyn Solve>>,
    pub(super) batch_size: BatchSize,
    pub(super) bad_rows: BadRowCounter,
    pub(super) progress: Progress,
    pub(super) outputs: Outputs,
    /// The proofs of `--certificates`.
    pub(super) certificates: Option<PairCertificates>,
    /// The rows chosen for the page of `--html`; `None` without this option.
    pub(super) html_rows: Option<ChosenRows>,
    pub(super) summary: Summary,
}

/// The answer to a row with the time that it took, or the problem of the row.
type RowAnswer = Result<TimedAnswer, RowProblem>;

impl Batches<MovementRow> for QueryRun<'_> {
    fn row_count(&self) -> usize {
        self.batch_size.row_count()
    }

    fn begin(&mut self, row_count: usize, end_byte: u64) {
        self.progress.begin_batch(row_count, end_byte);
    }

    fn answer_and_write(&mut self, rows: &[MovementRow]) -> Result<(), OutputError> {
        let answers = self.answer(rows);
        self.write(rows, &answers)
    }

    fn counts(&self) -> (usize, StatusCounts) {
        (self.bad_rows.count(), self.summary.counts)
    }

    fn save(&mut self, checkpoint: Checkpoint) -> Result<(), OutputError> {
        self.outputs.save(checkpoint)
    }
}

impl QueryRun<'_> {
    /// Answers the rows of a batch on all threads.
    fn answer(&mut self, batch: &[MovementRow]) -> Vec<RowAnswer> {
        let (bodies, timing, progress) = (self.bodies, &self.timed_question, &self.progress);
        let start = Instant::now();
        let answers = self.solver.map(batch, |solver, row| {
            let answer = match row {
                Ok((_, movements)) => answer_timed(bodies, movements, timing, solver.as_mut()),
                Err(error) => Err(error.problem.clone()),
            };
            progress.step();
            answer
        });
        self.batch_size.adapt(start.elapsed());
        answers
    }

    /// Writes the results and contacts of a batch of answered rows, and reports the bad ones.
    fn write(&mut self, batch: &[MovementRow], answers: &[RowAnswer]) -> Result<(), OutputError> {
        let (columns, mut answered) = (self.args.columns(), Vec::new());
        let timing = &self.timed_question;
        for (row, answer) in batch.iter().zip(answers) {
            let (position, movements, mut row) = match row {
                Ok((position, movements)) => {
                    let row = self.bodies.result_row(
                        timing.question,
                        &timing.settings,
                        movements,
                        answer,
                    );
                    (*position, Some(movements), row)
                }
                Err(error) => {
                    let row = ResultRow::error(&error.id, &error.problem);
                    (error.position, None, row)
                }
            };
            match answer {
                Ok(timed) => self.summary.add(row.status, timed),
                Err(problem) => {
                    self.bad_rows.report(position, problem, &self.progress);
                    self.summary.counts.add(Status::Error);
                }
            }
            row.micros = row.micros.filter(|_| !self.args.no_micros);
            if let (Some(shown), Some(movements)) = (&mut self.html_rows, movements) {
                shown.add_if_wanted(movements, &row);
            }
            self.outputs.results.add_row(&Line(&columns, &row))?;
            if let (Some(movements), Ok(timed)) = (movements, answer) {
                answered.push((position, movements, timed));
            }
        }
        self.find_and_write_contacts(&answered)?;
        self.prove_and_write(&answered)
    }

    /// Writes the proofs of the answered rows; a row whose answer cannot be proven counts as bad.
    fn prove_and_write(
        &mut self,
        answered: &[(RowPosition, &Movements, &TimedAnswer)],
    ) -> Result<(), OutputError> {
        let Some(certificates) = &self.certificates else {
            return Ok(());
        };
        let question = self.timed_question.question;
        for chunk in answered.chunks(PROVEN_BATCH_ROWS) {
            let proofs = self
                .solver
                .map(chunk, |_, (_, movements, timed)| match movements {
                    Movements::Motions(motions) => {
                        certificates.prove(motions, (question, &timed.answer))
                    }
                    Movements::Path(_) => None,
                });
            for ((position, movements, _), proof) in chunk.iter().zip(proofs) {
                match proof {
                    None => {}
                    Some(Ok(proof)) => {
                        let row = (position.row, None);
                        certificates
                            .folder
                            .write_proof(row, movements.id(), &proof)?;
                    }
                    Some(Err(error)) => {
                        let problem = format!("certificate: {error}");
                        self.bad_rows.report(*position, &problem, &self.progress);
                    }
                }
            }
        }
        Ok(())
    }

    /// Writes the contacts of the answered rows; a row with too many contacts counts as bad.
    fn find_and_write_contacts(
        &mut self,
        answered: &[(RowPosition, &Movements, &TimedAnswer)],
    ) -> Result<(), OutputError> {
        let Some(table) = &mut self.outputs.contacts else {
            return Ok(());
        };
        let (bodies, columns) = (self.bodies, contacts::columns());
        let timing = &self.timed_question;
        // A row may have very many contacts.
        for chunk in answered.chunks(CONTACT_BATCH_ROWS) {
            let contact_lists = self.solver.map(chunk, |_, (_, movements, timed)| {
                let answered = (timing.question, &timed.answer);
                contacts::contact_rows(bodies, movements, &timing.settings, answered)
            });
            for ((position, ..), rows) in chunk.iter().zip(contact_lists) {
                match rows {
                    Ok(rows) => {
                        for row in rows {
                            table.add_row(&Line(&columns, &row))?;
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

/// The number of rows whose proofs are in memory at the same time.
const PROVEN_BATCH_ROWS: usize = 64;

/// The number of rows whose contacts are in memory at the same time.
const CONTACT_BATCH_ROWS: usize = 64;
