//! Many queries on one pair of bodies, each timed alone.

use crate::engine::{Method, Solver};
use crate::motions::Query;
use crate::progress::Progress;
use ccd_core::{Answer, Body, Config, InputError, Moving, Problem};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::num::NonZeroUsize;
use std::time::Instant;

/// The two bodies of a query; both may be the same.
#[derive(Clone, Copy, Debug)]
pub struct Bodies<'a> {
    /// Body A.
    pub a: &'a Body,
    /// Body B.
    pub b: &'a Body,
}

/// How to answer.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// By what.
    pub method: Method,
    /// How accurately.
    pub config: Config,
    /// How often each query is answered; the time is the median.
    pub repeat: NonZeroUsize,
    /// On how many threads; any number gives the same answers.
    pub threads: NonZeroUsize,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            method: Method::default(),
            config: Config::default(),
            repeat: NonZeroUsize::MIN,
            threads: NonZeroUsize::MIN,
        }
    }
}

/// An answer and how long it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timed {
    /// What was answered.
    pub answer: Answer,
    /// Posing and solving, in microseconds.
    pub micros: f64,
}

/// Answers queries, in their order.
///
/// On one thread nothing but a query runs between two readings of the clock, and nothing but
/// bookkeeping between two queries.
///
/// # Errors
/// The outer one when threads cannot be had; an inner one where a query cannot be posed.
pub fn run<'q>(
    bodies: Bodies<'_>,
    queries: &[&'q Query],
    settings: &Settings,
    progress: &Progress,
) -> Result<Vec<Result<Timed, InputError>>, rayon::ThreadPoolBuildError> {
    let answer = |solver: &mut Box<dyn Solver>, query: &&'q Query| {
        let timed = time(bodies, query, settings, solver.as_mut());
        progress.step();
        timed
    };
    let solver = || settings.method.solver();
    if settings.threads == NonZeroUsize::MIN {
        let mut solver = solver();
        return Ok(queries
            .iter()
            .map(|query| answer(&mut solver, query))
            .collect());
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(settings.threads.get())
        .build()?;
    Ok(pool.install(|| queries.par_iter().map_init(solver, answer).collect()))
}

fn time(
    bodies: Bodies<'_>,
    query: &Query,
    settings: &Settings,
    solver: &mut dyn Solver,
) -> Result<Timed, InputError> {
    let mut micros = Vec::with_capacity(settings.repeat.get());
    loop {
        let start = Instant::now();
        let answer = solve(bodies, query, &settings.config, solver)?;
        micros.push(start.elapsed().as_secs_f64() * 1e6);
        if micros.len() == settings.repeat.get() {
            let micros = median(&mut micros);
            return Ok(Timed { answer, micros });
        }
    }
}

/// Poses and answers one query.
///
/// # Errors
/// As [`Problem::new`].
pub fn solve(
    bodies: Bodies<'_>,
    query: &Query,
    config: &Config,
    solver: &mut dyn Solver,
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

/// The middle value, the mean of the two middle ones, or NaN of none; sorts them.
pub fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    let upper = values.len() / 2;
    match values {
        [] => f64::NAN,
        _ if values.len() % 2 == 1 => values[upper],
        _ => 0.5 * (values[upper - 1] + values[upper]),
    }
}
