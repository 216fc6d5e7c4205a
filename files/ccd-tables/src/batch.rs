//! Answers many queries on one pair of bodies, and times each query.

mod batch_size;

pub use batch_size::BatchSize;

use crate::motions::RowProblem;
use crate::movements::Movements;
use crate::results::{ClearanceAndExcess, ResultRow};
use ccd_core::{Answer, Body, InputError, Query, Question, Settings};
use rigid_ccd::ParallelSolver;
use std::num::NonZeroUsize;

/// The two bodies of a query; both may be the same body.
#[derive(Clone, Copy, Debug)]
pub struct BodyPair<'a> {
    /// The body that the first motion of a row moves.
    pub a: &'a Body,
    /// The body that the second motion of a row moves.
    pub b: &'a Body,
}

impl<'q> BodyPair<'q> {
    /// Builds the query about both bodies for the motions or paths of a row. For a distance question, the bodies rest
    /// at their start poses.
    ///
    /// # Errors
    /// Those of [`Query::new`].
    pub fn build_query(
        self,
        question: Question,
        movements: &'q Movements,
        settings: &'q Settings,
    ) -> Result<Query<'q>, InputError> {
        let BodyPair { a, b } = self;
        if question == Question::Distance {
            let [pose_a, pose_b] = movements.poses_at(0.0)?;
            return Query::new((a, pose_a), (b, pose_b), 0.0, settings);
        }
        let [trajectory_a, trajectory_b] = movements.trajectories();
        Query::new(
            (a, trajectory_a),
            (b, trajectory_b),
            movements.duration(),
            settings,
        )
    }

    /// Returns the row of the table of results for the answer or error of a query.
    pub fn result_row(
        self,
        question: Question,
        settings: &Settings,
        movements: &Movements,
        answer: &Result<TimedAnswer, RowProblem>,
    ) -> ResultRow {
        let clearance_and_excess = self.clearance_and_excess(settings.clearance);
        match answer {
            Ok(timed) => ResultRow::new(
                movements,
                (question, &timed.answer),
                timed.micros,
                clearance_and_excess,
            ),
            Err(problem) => ResultRow::error(movements.id(), problem),
        }
    }

    /// Returns the clearance that distances are compared with, together with the sum of both bodies' excess.
    pub fn clearance_and_excess(self, clearance: Option<f64>) -> ClearanceAndExcess {
        ClearanceAndExcess {
            clearance,
            excess: self.a.excess() + self.b.excess(),
        }
    }
}

/// An answer, and the time that it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedAnswer {
    /// The answer to the question about one row.
    pub answer: Answer,
    /// The time to build and solve the query, in microseconds.
    pub micros: f64,
}

/// Creates a parallel solver with `threads` threads; `None` means one thread for each core.
pub fn parallel_solver<S>(threads: Option<u16>, solver: impl FnMut() -> S) -> ParallelSolver<S> {
    match threads.and_then(|threads| NonZeroUsize::new(threads.into())) {
        Some(threads) => ParallelSolver::with_threads(threads, solver),
        None => ParallelSolver::new(solver),
    }
}

/// Sorts values and returns their median, or NaN without values.
pub fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    let upper = values.len() / 2;
    match values {
        [] => f64::NAN,
        _ if values.len() % 2 == 1 => values[upper],
        _ => 0.5 * (values[upper - 1] + values[upper]),
    }
}
