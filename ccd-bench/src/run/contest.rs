//! Methods on scenes: each asked the same queries, timed, and judged by the referee.

mod journal;
mod session;
#[cfg(test)]
mod tests;
mod truths;
mod verdict;

use ccd_core::order::greater;
pub use journal::{Journal, JournalError};
pub use session::Session;
pub use truths::{Truths, TruthsError};
pub use verdict::{Judged, Verdict, judge};

use crate::method::rival::screw;
use crate::method::{Method, MotionKind};
use crate::run::measured::{Cell, Trial};
use crate::scene::Scene;
use crate::truth::{Referee, Surface, Truth};
use ccd_core::InputError;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use rigid_ccd::batch::{median, percentile};
use rigid_ccd::table::motions::Query;
use session::Answered;
use std::io;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A scene with what it takes to judge answers on it.
pub struct Contest<'s> {
    scene: &'s Scene,
    surfaces: [Arc<Surface>; 2],
    given: Vec<Query>,
    /// The same queries as screws.
    screws: Vec<Query>,
}

/// How long anybody is listened to.
#[derive(Clone, Copy, Debug)]
pub struct Allowance {
    /// For one method on one scene at one tolerance: no further query is asked after that.
    pub cell: Duration,
    /// For one query of a peer, which is stopped after that.
    pub patience: Duration,
    /// How many queries are asked at most.
    pub rows: usize,
    /// How many queries are asked at least, however long they take.
    pub least_rows: usize,
    /// For a method that prepares what it meets first: only what it has met by then is asked.
    pub rehearsal: Duration,
}

/// A schedule without a tree is only run where pairs of pieces come to at most this; it looks at all
/// pairs in every step.
const MOST_PAIRS_FOR_NAIVE: u64 = 100_000;

/// Why an method could not be heard.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ContestError {
    /// A query has no screw.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A peer's process cannot be started.
    #[error("{name} cannot be started: {source}")]
    Peer {
        /// The peer.
        name: String,
        /// Why.
        source: io::Error,
    },
}

impl<'s> Contest<'s> {
    /// Opens a scene.
    ///
    /// # Errors
    /// When a motion has no screw between its ends.
    pub fn new(scene: &'s Scene) -> Result<Self, ContestError> {
        let a = Arc::new(Surface::new(scene.a.mesh()));
        let b = match Arc::ptr_eq(&scene.a.body, &scene.b.body) {
            true => Arc::clone(&a),
            false => Arc::new(Surface::new(scene.b.mesh())),
        };
        let screws: Result<Vec<Query>, InputError> = scene.queries.iter().map(screw).collect();
        Ok(Contest {
            scene,
            surfaces: [a, b],
            given: scene.queries.clone(),
            screws: screws?,
        })
    }

    /// The queries, along one path or the other.
    pub fn queries(&self, path: MotionKind) -> &[Query] {
        match path {
            MotionKind::Given => &self.given,
            MotionKind::Screw => &self.screws,
        }
    }

    /// Judges answers on this scene.
    pub fn referee(&self) -> Referee<'_> {
        Referee::new(&self.surfaces[0], &self.surfaces[1])
    }

    /// Which rows are asked when there are to be that many: spread evenly, in an order such that any
    /// number of the first ones is spread, too.
    pub fn order(&self, most: usize) -> Vec<usize> {
        let count = self.given.len();
        let stride = (1..=count)
            .rev()
            .find(|&stride| 1618 * stride <= 1000 * count && coprime(stride, count))
            .unwrap_or(1);
        // The first row of a scene may be of a kind of its own: the middle comes first.
        let rows = (0..count).map(|k| (count / 2 + k * stride) % count.max(1));
        rows.take(most).collect()
    }

    /// Gives an method a session; none where it cannot enter.
    ///
    /// # Errors
    /// When a peer cannot be started.
    pub fn session(
        &self,
        method: Method,
        tolerance: f64,
    ) -> Result<Option<Session<'s>>, ContestError> {
        Session::take(method, self.scene, tolerance).map_err(not_started(method))
    }

    /// Tells an method another tolerance.
    ///
    /// # Errors
    /// When a peer cannot be started again.
    pub fn adjust(&self, session: &mut Session<'_>, tolerance: f64) -> Result<(), ContestError> {
        let failed = not_started(session.method());
        session.set_tolerance(tolerance).map_err(failed)
    }

    /// Asks an method, and judges what it says; none where it can be asked none of the queries.
    ///
    /// # Errors
    /// When a peer that was stopped cannot be started again.
    pub fn run(
        &self,
        session: &mut Session<'_>,
        allowance: &Allowance,
        truths: &Truths,
    ) -> Result<Option<(Cell, Vec<Trial>)>, ContestError> {
        let (method, tolerance) = (session.method(), session.tolerance());
        let queries = self.queries(method.motion_kind());
        let order = self.order(allowance.rows);
        let rehearsed = session.rehearse(order.iter().map(|&r| &queries[r]), allowance.rehearsal);
        let mut asked: Vec<(usize, Answered)> = Vec::new();
        let start = Instant::now();
        for &row in &order[..rehearsed] {
            let enough = asked.len() >= allowance.least_rows;
            if start.elapsed() > allowance.cell && enough {
                break;
            }
            let answered = session.ask(&queries[row], allowance.patience);
            let answered = answered.map_err(not_started(method))?;
            if !answered.is_refusal() {
                asked.push((row, answered));
            }
        }
        if asked.is_empty() {
            return Ok(None);
        }
        asked.sort_by_key(|(row, _)| *row);
        let truths = truths.of(self, method.motion_kind());
        let method = method.to_string();
        let trials: Vec<Trial> = asked
            .par_iter()
            .map(|(row, answered)| {
                let query = &queries[*row];
                let judged = self.judged(query, truths(*row), answered, tolerance);
                Trial {
                    scene: self.scene.name.clone(),
                    method: method.clone(),
                    tolerance,
                    row: *row,
                    id: query.id.clone(),
                    micros: answered.micros(),
                    steps: answered.steps(),
                    verdict: judged.verdict.to_string(),
                    error: judged.error.unwrap_or(f64::NAN),
                }
            })
            .collect();
        Ok(Some((sum_up(&trials), trials)))
    }

    fn judged(&self, query: &Query, truth: Truth, answered: &Answered, tolerance: f64) -> Judged {
        match answered {
            Answered::InTime { reply, .. } => {
                judge(&self.referee(), query, truth, reply.claim, tolerance)
            }
            Answered::CutOff { .. } => Judged::plain(Verdict::CutOff),
            Answered::Died => Judged::plain(Verdict::Died),
        }
    }

    /// The scene.
    pub fn scene(&self) -> &'s Scene {
        self.scene
    }
}

fn not_started(method: Method) -> impl Fn(io::Error) -> ContestError {
    move |source| ContestError::Peer {
        name: method.to_string(),
        source,
    }
}

/// What trials of one method on one scene come to; there is at least one.
pub fn sum_up(trials: &[Trial]) -> Cell {
    let count = |verdict: Verdict| {
        let name = verdict.to_string();
        trials.iter().filter(|t| t.verdict == name).count()
    };
    // Of what a peer died of there is no time.
    let known = trials.iter().map(|t| t.micros).filter(|m| !m.is_nan());
    let mut micros: Vec<f64> = known.collect();
    let errors: Vec<f64> = trials
        .iter()
        .map(|t| t.error)
        .filter(|e| !e.is_nan())
        .collect();
    let rows = trials.len();
    let first = trials.first();
    let cut_off = count(Verdict::CutOff) + count(Verdict::Died);
    Cell {
        scene: first.map_or_else(String::new, |t| t.scene.clone()),
        method: first.map_or_else(String::new, |t| t.method.clone()),
        tolerance: first.map_or(f64::NAN, |t| t.tolerance),
        rows,
        median_us: median(&mut micros),
        mean_us: mean(&micros),
        p95_us: percentile(&micros, 0.95),
        late: count(Verdict::Late),
        missed: count(Verdict::Missed),
        false_contacts: count(Verdict::False),
        unresolved: count(Verdict::Unresolved) + cut_off,
        mean_error: mean(&errors),
        max_error: errors.iter().copied().reduce(greater).unwrap_or(f64::NAN),
        early: count(Verdict::Early),
        cut_off,
        undecided: count(Verdict::Undecided),
        mean_steps: trials.iter().map(|t| t.steps as f64).sum::<f64>() / rows as f64,
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn coprime(a: usize, b: usize) -> bool {
    match b {
        0 => a == 1,
        _ => coprime(b, a % b),
    }
}
