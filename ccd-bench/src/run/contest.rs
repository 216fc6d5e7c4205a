//! Runs methods on a scene, so that each method gets the same queries, is timed, and is judged by the referee.

mod journal;
mod session;
#[cfg(test)]
mod tests;

use ccd_core::order::greater;
pub use journal::{Journal, program_fingerprint};
pub use session::Session;

use crate::method::guarded::QueryOutcome;
use crate::method::rival::to_screw_motions;
use crate::method::solver::ContactClaim;
use crate::run::measured::{MeasurementCell, Trial};
pub use crate::run::verdict::{Judgement, Verdict, judge, judge_outcome};
use crate::scene::Scene;
use crate::truth::{Surface, Truth, TruthSolver};
use anyhow::{Context, Result};
use ccd_core::InputError;
use ccd_tables::batch::median;
use ccd_tables::motions::Motions;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// A scene with the surfaces of its bodies, prepared for running methods and judging their answers.
pub struct PreparedScene<'s> {
    scene: &'s Scene,
    surfaces: [Surface; 2],
    constant_velocity_rows: Vec<QueryWithTruth>,
    /// The queries of the scene, with each motion replaced by the screw motion between its start and end poses.
    screw_rows: Vec<QueryWithTruth>,
}

/// A query of a scene, with its exact answer once that is known.
struct QueryWithTruth {
    query: Motions,
    truth: OnceLock<Truth>,
}

/// The limits on time and rows of a measurement.
#[derive(Clone, Copy, Debug)]
pub struct MeasurementLimits {
    /// The time for one method on one scene at one tolerance, after which no more queries are started.
    pub cell_time: Duration,
    /// The time limit of one query of a peer, which is then stopped.
    pub patience: Duration,
    /// The maximum number of queries to ask.
    pub max_rows: usize,
    /// The number of queries that are asked even if the time for the cell is over.
    pub min_rows: usize,
    /// The time limit for preparing the pieces of a method that makes them on first use. Only queries that are prepared
    /// by then are asked.
    pub preparation_limit: Duration,
}

/// The maximum number of pairs of pieces on which the naive schedule is run, which processes all pairs in every step.
pub const MAX_PAIRS_FOR_NAIVE_SCHEDULE: u64 = 100_000;

impl<'s> PreparedScene<'s> {
    /// Prepares a scene: makes the surfaces for the referee, and the screw motions of all queries.
    ///
    /// # Errors
    /// If a motion has no screw between its ends.
    pub fn new(scene: &'s Scene) -> Result<Self> {
        let queries = scene.queries.iter();
        let screws = queries
            .clone()
            .map(|query| to_screw_motions(query).map(QueryWithTruth::new));
        Ok(PreparedScene {
            scene,
            surfaces: [&scene.a, &scene.b].map(|body| Surface::new(body.mesh())),
            screw_rows: screws.collect::<Result<_, InputError>>()?,
            constant_velocity_rows: queries.cloned().map(QueryWithTruth::new).collect(),
        })
    }

    /// Judges the outcome of a query by the exact answer, which is computed when it is first needed.
    fn judge(&self, row: &QueryWithTruth, outcome: &QueryOutcome, tolerance: f64) -> Judgement {
        let referee = TruthSolver::new(&self.surfaces[0], &self.surfaces[1]);
        judge_outcome(outcome, |reply| {
            let truth = row.truth.get_or_init(|| referee.first_contact(&row.query));
            judge(&referee, &row.query, *truth, reply.claim, tolerance)
        })
    }

    /// Returns the indices of the first `most` queries, in the order in which they are asked. The rows are spread
    /// evenly, and so is any number of the first ones.
    pub fn spread_row_indices(&self, most: usize) -> Vec<usize> {
        let count = self.scene.queries.len();
        let stride = (1..=count)
            .rev()
            .find(|&stride| 1618 * stride <= 1000 * count && are_coprime(stride, count))
            .unwrap_or(1);
        // The first row of a scene may be of a special kind, so the middle row comes first.
        let rows = (0..count).map(|k| (count / 2 + k * stride) % count.max(1));
        rows.take(most).collect()
    }

    /// Asks a method the queries within the limits, and judges its answers. Returns `None` if it can be asked none of
    /// the queries.
    ///
    /// # Errors
    /// If a stopped peer cannot be restarted.
    pub fn run(
        &self,
        session: &mut Session<'_>,
        tolerance: f64,
        allowance: &MeasurementLimits,
    ) -> Result<Option<(MeasurementCell, Vec<Trial>)>> {
        let method = session.method();
        let rows = if method.moves_along_screws() {
            &self.screw_rows
        } else {
            &self.constant_velocity_rows
        };
        let order = self.spread_row_indices(allowance.max_rows);
        let asked_for = order.iter().map(|&row| &rows[row].query);
        let prepared =
            session.run_warm_up_queries(asked_for, tolerance, allowance.preparation_limit);
        let mut asked: Vec<(usize, QueryOutcome)> = Vec::new();
        let start = Instant::now();
        for &row in &order[..prepared] {
            let enough = asked.len() >= allowance.min_rows;
            if start.elapsed() > allowance.cell_time && enough {
                break;
            }
            let answered = session.ask(&rows[row].query, tolerance, allowance.patience);
            let answered = answered.with_context(|| format!("{method} cannot be started"))?;
            if answered.reply().map(|reply| reply.claim) != Some(ContactClaim::Refused) {
                asked.push((row, answered));
            }
        }
        if asked.is_empty() {
            return Ok(None);
        }
        asked.sort_by_key(|(row, _)| *row);
        let method = method.to_string();
        let trials: Vec<Trial> = asked
            .par_iter()
            .map(|(row, answered)| {
                Trial::new(
                    (&self.scene.name, &method, tolerance),
                    (*row, &rows[*row].query.id),
                    (answered, allowance.patience),
                    (self.judge(&rows[*row], answered, tolerance), String::new()),
                )
            })
            .collect();
        Ok(Some((summarise_trials(&trials), trials)))
    }

    /// Returns the scene that the methods are run on.
    pub fn scene(&self) -> &'s Scene {
        self.scene
    }
}

impl QueryWithTruth {
    fn new(query: Motions) -> Self {
        QueryWithTruth {
            query,
            truth: OnceLock::new(),
        }
    }
}

/// Summarises the trials of one method on one scene at one tolerance. There is at least one trial.
pub fn summarise_trials(trials: &[Trial]) -> MeasurementCell {
    let count = |verdict: Verdict| {
        let name = verdict.to_string();
        trials.iter().filter(|t| t.verdict == name).count()
    };
    // A query at which a peer died has no time.
    let known = trials.iter().map(|t| t.micros).filter(|m| !m.is_nan());
    let mut micros: Vec<f64> = known.collect();
    let errors: Vec<f64> = trials.iter().filter_map(|t| t.error).collect();
    let rows = trials.len();
    let first = trials.first();
    let cut_off = count(Verdict::CutOff) + count(Verdict::Crashed);
    MeasurementCell {
        scene: first.map_or_else(String::new, |t| t.scene.clone()),
        method: first.map_or_else(String::new, |t| t.method.clone()),
        tolerance: first.map_or(f64::NAN, |t| t.tolerance),
        rows,
        median_us: median(&mut micros),
        mean_us: mean(&micros),
        p95_us: percentile(&micros, 0.95),
        late: count(Verdict::Late),
        missed: count(Verdict::Missed),
        false_contacts: count(Verdict::FalseContact),
        unresolved: count(Verdict::Unresolved) + cut_off,
        mean_error: (!errors.is_empty()).then(|| mean(&errors)),
        max_error: errors.iter().copied().reduce(greater),
        early: count(Verdict::Early),
        cut_off,
        undecided: count(Verdict::Undecided),
        mean_steps: trials.iter().map(|t| t.steps as f64).sum::<f64>() / rows as f64,
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn are_coprime(a: usize, b: usize) -> bool {
    match b {
        0 => a == 1,
        _ => are_coprime(b, a % b),
    }
}

/// Returns a percentile of sorted values, where the percentile is a fraction from 0 to 1; NaN without values.
fn percentile(sorted: &[f64], fraction: f64) -> f64 {
    let within = (fraction * sorted.len() as f64).ceil() as usize;
    within.checked_sub(1).map_or(f64::NAN, |k| sorted[k])
}
