//! Answers many queries on all cores.

use crate::Solver;
use ccd_core::{Answer, DistanceOracle, InputError, MovingBody};
use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{self, Builder, available_parallelism};

/// Finds the first contact of each pair of moving bodies, on all cores.
///
/// A query has the arguments of [`first_contact`](crate::first_contact): both bodies with their motions,
/// and the duration. The pairs may be of different bodies. The answers are in the order of the queries, and
/// the same bits on any number of cores. A [`ParallelSolver`] takes a number of threads, a tolerance or a
/// limit, and keeps its memory from call to call.
///
/// # Errors
/// Each query has a result of its own. Its error is that of [`first_contact`](crate::first_contact), with
/// the index of the query.
///
/// ```
/// use rigid_ccd::{Body, Motion, Pose, first_contacts};
/// let (ball, wall) = (Body::sphere(0.5)?, Body::cuboid([0.1, 5.0, 5.0])?);
/// let left = Pose::at([-3.0, 0.0, 0.0])?;
/// let mut queries = Vec::new();
/// for speed in [1.0, 2.0, 4.0] {
///     let flies = Motion::new(left, [speed, 0.0, 0.0], [0.0; 3])?;
///     queries.push(((&ball, flies), (&wall, Motion::STILL), 1.0));
/// }
/// for (query, found) in queries.iter().zip(first_contacts(&queries)) {
///     assert_eq!(found?.hit()?.is_some(), query.0.1.velocity().x > 2.4);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn first_contacts<'b, A, B>(queries: &[(A, B, f64)]) -> Vec<Result<Answer, QueryError>>
where
    A: Into<MovingBody<'b>> + Copy + Sync,
    B: Into<MovingBody<'b>> + Copy + Sync,
{
    ParallelSolver::new(Solver::new).first_contacts(queries)
}

/// The error of one of many queries, with the index of the query.
#[derive(Debug, thiserror::Error)]
#[error("query {query_index}: {error}")]
pub struct QueryError {
    /// The index of the query among the given queries, counted from 0.
    pub query_index: usize,
    /// The reason why the input of the query is not valid.
    #[source]
    pub error: InputError,
}

/// Solvers that answer many queries in parallel, one on each thread. Keep it between calls: it reuses its memory.
///
/// Each thread takes the next query when it has answered one, so that a few slow queries do not hold up the
/// others. Answers are in the order of the queries. They are the same bits on any number of threads, unless a
/// [deadline](ccd_core::Settings::deadline) ends a query.
///
/// A panic ends a call: the threads take no more queries, and the panic goes on in the caller.
///
/// ```
/// use rigid_ccd::{Body, Motion, ParallelSolver, Pose, Settings, Solver};
/// use std::num::NonZeroUsize;
///
/// let settings = Settings { tolerance: 1e-6, ..Settings::DEFAULT };
/// let threads = NonZeroUsize::new(2).expect("not 0");
/// let mut solver = ParallelSolver::with_threads(threads, || {
///     Solver::new().with_settings(settings.clone())
/// });
///
/// // The edges of a planner, against both links of an arm.
/// let (gripper, forearm) = (Body::sphere(0.2)?, Body::capsule(0.1, 0.6)?);
/// let shelf = Body::cuboid([1.0, 0.3, 0.05])?;
/// let mut queries = Vec::new();
/// for height in [0.0, 0.2, 0.4] {
///     let reach = Motion::new(Pose::at([0.0, -2.0, height])?, [0.0, 2.0, 0.0], [0.0; 3])?;
///     for link in [&gripper, &forearm] {
///         queries.push(((link, reach), (&shelf, Motion::STILL), 1.0));
///     }
/// }
/// let mut hits = Vec::new();
/// for answer in solver.first_contacts(&queries) {
///     hits.push(answer?.hit()?.is_some());
/// }
/// assert_eq!(hits, [true, true, true, true, false, true]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct ParallelSolver<S = Solver> {
    /// The solvers, one for each thread, and at least one.
    solvers: Vec<CachePadded<S>>,
}

/// A value aligned to its own cache lines, which avoids false sharing between threads. Processors fetch lines of 64
/// bytes in pairs. Two lines, where the one of `crossbeam-utils` is a dependency.
#[repr(align(128))]
pub struct CachePadded<S>(pub S);

impl<S> ParallelSolver<S> {
    /// Creates a solver for each core, for example `ParallelSolver::new(Solver::new)`.
    pub fn new(solver: impl FnMut() -> S) -> Self {
        let cores = available_parallelism().unwrap_or(NonZeroUsize::MIN);
        ParallelSolver::with_threads(cores, solver)
    }

    /// Creates a solver for each of `threads` threads.
    pub fn with_threads(threads: NonZeroUsize, mut solver: impl FnMut() -> S) -> Self {
        let solvers = (0..threads.get()).map(|_| CachePadded(solver())).collect();
        ParallelSolver { solvers }
    }

    /// Returns the number of threads, each of which has a solver.
    pub fn threads(&self) -> usize {
        self.solvers.len()
    }
}

impl<O> ParallelSolver<Solver<O>>
where
    O: DistanceOracle + Send,
    O::Cache: Send,
{
    /// Finds the first contact of each pair, as the function [`first_contacts`] does.
    ///
    /// # Errors
    /// The errors of [`first_contacts`], for each query alone.
    pub fn first_contacts<'b, A, B>(
        &mut self,
        queries: &[(A, B, f64)],
    ) -> Vec<Result<Answer, QueryError>>
    where
        A: Into<MovingBody<'b>> + Copy + Sync,
        B: Into<MovingBody<'b>> + Copy + Sync,
    {
        let found = self.map(queries, |solver, &(a, b, duration)| {
            solver.first_contact(a, b, duration)
        });
        let found = found.into_iter().enumerate();
        found
            .map(|(query, found)| {
                found.map_err(|error| QueryError {
                    query_index: query,
                    error,
                })
            })
            .collect()
    }
}

impl<S: Send> ParallelSolver<S> {
    /// Calls `answer` with a solver and each query, in parallel, and returns the results in the order of the queries.
    ///
    /// Queries and results may be of any type. All results are in memory at one time; pass very many queries in
    /// parts.
    ///
    /// The caller's thread works as well. The others last for this call, and where one cannot be started,
    /// the rest do its work. No thread waits for a lock.
    ///
    /// # Panics
    /// `answer` panics.
    ///
    /// ```
    /// use rigid_ccd::{Body, Motion, Outcome, ParallelSolver, Pose, Solver};
    /// let ball = Body::sphere(0.5)?;
    /// let flies = |speed| Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [speed, 0.0, 0.0], [0.0; 3]);
    /// let speeds: Vec<f64> = (1..100).map(f64::from).collect();
    /// let answers = ParallelSolver::new(Solver::new).map(&speeds, |solver, &speed| {
    ///     solver.first_contact((&ball, flies(speed)?), (&ball, Motion::STILL), 1.0)
    /// });
    /// for (&speed, answer) in speeds.iter().zip(answers) {
    ///     assert_eq!(matches!(answer?.outcome, Outcome::Contact { .. }), speed > 1.0);
    /// }
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn map<Q: Sync, R: Send>(
        &mut self,
        queries: &[Q],
        answer: impl Fn(&mut S, &Q) -> R + Sync,
    ) -> Vec<R> {
        // The counter only distributes the queries; joining a thread makes its results visible.
        let counter = CachePadded(AtomicUsize::new(0));
        let next = || {
            let index = counter.0.fetch_add(1, Ordering::Relaxed);
            Some((index, queries.get(index)?))
        };
        self.answer_on_threads(queries.len(), next, answer)
    }

    /// Calls `answer` with a solver and each query of an iterator, in parallel, and returns the results in the order of
    /// the queries.
    ///
    /// It is [`map`](ParallelSolver::map) for queries that are read or made while others are answered. A lock
    /// guards the iterator: let an item be many queries if they are short. The threads end after the
    /// iterator's first `None`.
    ///
    /// # Panics
    /// `answer` or the iterator panics.
    ///
    /// ```
    /// use rigid_ccd::{Body, Motion, ParallelSolver, Pose, Solver};
    /// let ball = Body::sphere(0.5)?;
    /// let flies = |speed| Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [speed, 0.0, 0.0], [0.0; 3]);
    /// let speeds = std::iter::successors(Some(1.0), |speed| Some(2.0 * speed)).take(10);
    /// let hits = ParallelSolver::new(Solver::new).map_iter(speeds, |solver, speed| {
    ///     let found = solver.first_contact((&ball, flies(speed)?), (&ball, Motion::STILL), 1.0)?;
    ///     Ok::<bool, rigid_ccd::Error>(found.hit()?.is_some())
    /// });
    /// assert_eq!(hits.into_iter().filter(|hit| matches!(hit, Ok(true))).count(), 9);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn map_iter<Q: Send, R: Send>(
        &mut self,
        queries: impl IntoIterator<Item = Q, IntoIter: Send>,
        answer: impl Fn(&mut S, Q) -> R + Sync,
    ) -> Vec<R> {
        let queries = queries.into_iter();
        let most = queries.size_hint().1.unwrap_or(usize::MAX);
        let queries = Mutex::new(queries.fuse().enumerate());
        // The lock is poisoned if the iterator panicked; no work is left then.
        let next = || queries.lock().ok()?.next();
        self.answer_on_threads(most, next, answer)
    }

    /// Calls `answer` on each query that `next` returns, on at most `most` threads, and returns the results in the
    /// order of the queries' indices.
    fn answer_on_threads<Q, R: Send>(
        &mut self,
        most: usize,
        next: impl Fn() -> Option<(usize, Q)> + Sync,
        answer: impl Fn(&mut S, Q) -> R + Sync,
    ) -> Vec<R> {
        let panicked = CachePadded(AtomicBool::new(false));
        let work = |own: &mut CachePadded<S>| {
            let _tells = PanicGuard(&panicked.0);
            let mut results = Vec::new();
            while !panicked.0.load(Ordering::Relaxed)
                && let Some((index, query)) = next()
            {
                results.push((index, answer(&mut own.0, query)));
            }
            results
        };
        let useful = self.solvers.len().min(most);
        let Some((mine, others)) = self.solvers[..useful].split_first_mut() else {
            return Vec::new();
        };
        let mut results = thread::scope(|scope| {
            let start = |own| Builder::new().spawn_scoped(scope, || work(own)).ok();
            let others: Vec<_> = others.iter_mut().map_while(start).collect();
            let mut results = work(mine);
            for other in others {
                results.extend(other.join().unwrap_or_else(|panic| resume_unwind(panic)));
            }
            results
        });
        results.sort_by_key(|&(index, _)| index);
        results.into_iter().map(|(_, result)| result).collect()
    }
}

/// Sets a flag when this thread panics, so that the other threads stop.
struct PanicGuard<'f>(&'f AtomicBool);

impl Drop for PanicGuard<'_> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.store(true, Ordering::Relaxed);
        }
    }
}

#[cfg(test)]
mod tests;
