//! Queries answered by a method that is chosen at run time, each with its time.

use super::{Bodies, Found, Question, Solve, SolverKind, median};
use crate::table::courses::Course;
use crate::table::motions::{Query, RowProblem};
use ccd_core::{Answer, Config, InputError, Moving, Problem};
use std::num::NonZeroUsize;
use std::time::Instant;

/// The question, the method, the accuracy and the number of repetitions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings {
    /// The question that every row answers.
    pub(crate) question: Question,
    /// The schedule and the distance backend.
    pub(crate) method: SolverKind,
    /// The tolerance, the margin and the limits.
    pub(crate) config: Config,
    /// The number of times that each query is answered; the time is the median.
    pub(crate) repeat: NonZeroUsize,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            question: Question::default(),
            method: SolverKind::default(),
            config: Config::default(),
            repeat: NonZeroUsize::MIN,
        }
    }
}

/// An answer and how long it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Timed {
    /// The answer.
    pub(crate) answer: Answer<Found>,
    /// The time to pose and solve the query, in microseconds.
    pub(crate) micros: f64,
}

/// Answers a query as often as the settings say.
///
/// On one thread, only the query runs between two readings of the clock. On all cores, queries share
/// caches and memory, and each may take longer.
///
/// # Errors
/// The query is not valid, or the method does not answer the question.
pub(crate) fn time(
    bodies: Bodies<'_>,
    course: &Course,
    settings: &Settings,
    solver: &mut dyn Solve,
) -> Result<Timed, RowProblem> {
    let mut micros = Vec::with_capacity(settings.repeat.get());
    loop {
        let start = Instant::now();
        let answer = answer(bodies, course, settings, solver)?;
        micros.push(start.elapsed().as_secs_f64() * 1e6);
        if micros.len() == settings.repeat.get() {
            let micros = median(&mut micros);
            return Ok(Timed { answer, micros });
        }
    }
}

fn answer(
    bodies: Bodies<'_>,
    course: &Course,
    settings: &Settings,
    solver: &mut dyn Solve,
) -> Result<Answer<Found>, RowProblem> {
    let Settings {
        question, config, ..
    } = settings;
    match (question, course) {
        (Question::FirstContact, Course::Motions(query)) => {
            Ok(solve(bodies, query, config, solver)?.map(Found::First))
        }
        _ => match solver.questions() {
            Some(solver) => Ok(solver.ask(*question, bodies, course, config)?),
            None => Err(RowProblem::NeedsBestFirst),
        },
    }
}

/// Poses and answers one query.
///
/// # Errors
/// The errors of [`Problem::new`].
pub fn solve(
    bodies: Bodies<'_>,
    query: &Query,
    config: &Config,
    solver: &mut dyn Solve,
) -> Result<Answer, InputError> {
    let a = Moving {
        body: bodies.a,
        motion: query.a,
    };
    let b = Moving {
        body: bodies.b,
        motion: query.b,
    };
    let problem = Problem::new(a, b, query.duration, config)?;
    Ok(solver.solve(&problem))
}
