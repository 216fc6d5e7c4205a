//! All pairs of pieces, one common clock: Alg. 1 of the paper, the slow and obvious twin.

use super::Schedule;
use super::pair::Pair;
use super::start::{self, Start};
use crate::oracle::DistanceOracle;
use crate::outcome::{Answer, Limit, Outcome, Stats};
use crate::problem::Problem;
use std::ops::ControlFlow;

/// Advances all pairs of pieces together by the least of their free times `[FAST06 Alg. 1]`.
///
/// Every step costs one distance for each pair of pieces: only for bodies of few pieces, and to
/// check the other schedules by.
#[derive(Debug)]
pub struct Naive<O: DistanceOracle> {
    pairs: Vec<Pair<O::Cache>>,
}

impl<O: DistanceOracle> Default for Naive<O> {
    fn default() -> Self {
        Naive { pairs: Vec::new() }
    }
}

impl<O: DistanceOracle> Schedule<O> for Naive<O> {
    fn solve(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        let mut stats = Stats::default();
        let (outcome, tolerance) =
            start::search(problem, |problem| self.search(problem, oracle, &mut stats));
        stats.peak_front = self.pairs.len() as u64;
        Answer {
            outcome,
            tolerance,
            stats,
        }
    }
}

impl<O: DistanceOracle> Naive<O> {
    fn search(&mut self, problem: &Problem<'_>, oracle: &mut O, stats: &mut Stats) -> Outcome {
        let (a, b) = (problem.a.body.pieces().len(), problem.b.body.pieces().len());
        let unresolved = |s: f64, reason| Outcome::Unresolved {
            safe_until: problem.time(s),
            reason,
        };
        self.pairs.clear();
        let all = a as u64 * b as u64;
        if all > problem.budget {
            return unresolved(0.0, Limit::Budget);
        }
        let pairs = (0..a as u32).flat_map(|i| (0..b as u32).map(move |j| Pair::new(i, j)));
        self.pairs.extend(pairs);
        let mut start = Start::default();
        let mut s = 0.0;
        while s < 1.0 {
            stats.node_visits += all;
            if stats.node_visits > problem.budget {
                return unresolved(s, Limit::Budget);
            }
            let mut next = f64::INFINITY;
            for pair in &mut self.pairs {
                let step = pair.advance(problem, oracle, stats, s);
                match start.settle(problem, step, s) {
                    ControlFlow::Continue(Some(clock)) => next = next.min(clock),
                    ControlFlow::Continue(None) => {}
                    ControlFlow::Break(outcome) => return outcome,
                }
            }
            if let Some(outcome) = start.end(problem) {
                return outcome;
            }
            s = next;
        }
        Outcome::Free {
            clearance: problem.clearance(f64::INFINITY),
        }
    }
}
