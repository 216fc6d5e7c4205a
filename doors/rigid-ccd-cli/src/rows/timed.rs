//! Answers and times queries by a method that is chosen at run time.

use crate::options::solver_kind::{Solve, SolverKind};
use ccd_core::Settings;
use ccd_tables::batch::{BodyPair, TimedAnswer, median};
use ccd_tables::motions::RowProblem;
use ccd_tables::movements::Movements;
use rigid_ccd::Question;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

/// The question about each row, with the method, the settings and the number of repetitions for timing.
#[derive(Clone, Debug)]
pub(crate) struct TimedQuestion {
    /// The question that every row answers.
    pub(crate) question: Question,
    /// The schedule and the distance backend.
    pub(crate) method: SolverKind,
    /// The tolerance, the margin, the limits and the other settings of each query.
    pub(crate) settings: Settings,
    /// The number of times that each query is answered; the time is the median.
    pub(crate) repetitions: NonZeroUsize,
}

/// Answers a query as often as `timed_question` says, and returns the answer with the median time.
///
/// On one thread, only the query runs between two readings of the clock. On all cores, queries share
/// caches and memory, and each may take longer.
///
/// # Errors
/// The query is not valid, or the method does not answer the question.
pub(crate) fn answer_timed(
    bodies: BodyPair<'_>,
    movements: &Movements,
    timed_question: &TimedQuestion,
    solver: &mut dyn Solve,
) -> Result<TimedAnswer, RowProblem> {
    let mut micros = Vec::with_capacity(timed_question.repetitions.get());
    loop {
        let start = Instant::now();
        let query =
            bodies.build_query(timed_question.question, movements, &timed_question.settings)?;
        let answer = solver.answer(timed_question.question, &query);
        let answer = answer.ok_or(RowProblem::NeedsBestFirst)??;
        micros.push(microseconds(start.elapsed()));
        if micros.len() == timed_question.repetitions.get() {
            let micros = median(&mut micros);
            return Ok(TimedAnswer { answer, micros });
        }
    }
}

/// Returns a duration in microseconds, to a nanosecond: with as few digits as that takes.
pub(crate) fn microseconds(duration: Duration) -> f64 {
    duration.as_nanos() as f64 / 1e3
}

#[cfg(test)]
mod tests;
