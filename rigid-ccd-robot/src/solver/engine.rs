//! What the search leaves to the engine: bodies that are not convex, and pairs that are candidate after all halvings.

use super::Goal;
use super::curved_link::PathSection;
use super::engine_candidates::EngineCandidate;
use super::part_pairs::{PartPair, sort_by_proof_distance};
use super::search::PathSearch;
use crate::path::interval::{PathInterval, StepResult};
use crate::tuning::MAX_BUDGET_SPLITS;
use ccd_core::order::{greater, lesser};
use rigid_ccd::answer::{ClearanceVerdict, Limit};
use rigid_ccd::{Answer, ContactNormals, Error, Outcome, Settings, StartPolicy};
use std::ops::ControlFlow::{self, Break, Continue};

impl PathSearch<'_> {
    /// Asks the engine whether one of the candidates is in contact in the middle of an interval.
    pub(super) fn check_nonconvex_candidates(&mut self, interval: &PathInterval) -> StepResult {
        let at = interval.middle();
        if self.nonconvex_candidates.is_empty() {
            return Ok(Continue(()));
        }
        let mut candidates = std::mem::take(&mut self.nonconvex_candidates);
        sort_by_proof_distance(&mut candidates);
        let mut step = Ok(Continue(()));
        for (k, pair) in candidates.iter().enumerate() {
            let bodies = pair.body_indices(self.cell.parts());
            let mut earlier = candidates[..k].iter();
            if earlier.any(|other| bodies == other.body_indices(self.cell.parts())) {
                continue;
            }
            step = match self.check_limit(interval) {
                Break(()) => Ok(Break(())),
                Continue(()) => self.check_nonconvex_candidate(pair, bodies, at),
            };
            // An earlier contact than one at this point has another middle.
            if !matches!(step, Ok(Continue(()))) || self.result.end <= at {
                break;
            }
        }
        self.nonconvex_candidates = candidates;
        step
    }

    fn check_nonconvex_candidate(
        &mut self,
        pair: &PartPair,
        bodies: [usize; 2],
        at: f64,
    ) -> StepResult {
        let goal = match self.goal {
            Goal::FirstContact => Goal::AnyContact,
            other => other,
        };
        let candidate = EngineCandidate::new_at_point(*pair, bodies, at);
        let answer = self.query_engine(goal, &candidate, None)?;
        if goal == Goal::LeastDistance {
            return Ok(self.record_distance(&candidate, &answer.outcome));
        }
        // A pair that a limit leaves undecided here stays a candidate.
        Ok(match answer.outcome.hit() {
            Ok(Some(_)) => {
                let beyond = self.distance_beyond_margin(pair, &answer.outcome);
                self.record_contact(pair, at, beyond)
            }
            Ok(None) | Err(_) => Continue(()),
        })
    }

    /// Lets the engine decide about each candidate pair.
    pub(super) fn decide_engine_candidates(&mut self) -> Result<(), Error> {
        let mut candidate = std::mem::take(&mut self.engine_candidates);
        let result = self.decide(candidate.sorted_for(self.goal));
        self.engine_candidates = candidate;
        result
    }

    fn decide(&mut self, candidate: &[EngineCandidate]) -> Result<(), Error> {
        for pair in candidate {
            if pair.from >= self.result.end {
                continue;
            }
            if let Some(limit) = self.stop_condition.reached_limit() {
                // For the first contact the pairs are in the order of their starts: all before this one is decided.
                let until = match self.goal {
                    Goal::FirstContact => pair.from,
                    Goal::AnyContact | Goal::LeastDistance => 0.0,
                };
                self.result.limit_reached = Some((limit, until));
                self.result.lower = 0.0;
                break;
            }
            if self.decide_pair(*pair, MAX_BUDGET_SPLITS)?.is_break() {
                break;
            }
        }
        Ok(())
    }

    /// Lets the engine decide about an candidate pair. If the budget of a query does not suffice, its interval is halved, as often as
    /// `splits` says and as long as budgets are left for the question.
    fn decide_pair(&mut self, mut pair: EngineCandidate, splits: u32) -> StepResult {
        if pair.from >= self.result.end {
            return Ok(Continue(()));
        }
        pair.to = lesser(pair.to, self.result.end);
        // Over a period a pair comes near many times: one budget hardly suffices.
        if splits > 0 && self.drift(&pair) > 0.0 {
            return self.decide_halves(&pair, splits - 1);
        }
        if self.goal == Goal::LeastDistance {
            // Nothing is nearer by more than the tolerance. Written so that NaN is measured.
            if self.result.distance_upper_bound - self.tolerance <= 0.0 {
                return Ok(Break(()));
            }
            if self.is_no_nearer(&pair)? {
                return Ok(Continue(()));
            }
        }
        let outcome = self.query_engine(self.goal, &pair, None)?.outcome;
        let is_spent = outcome.limit() == Some(Limit::Budget);
        if is_spent && splits > 0 && self.stop_condition.reached_limit().is_none() {
            if self.goal == Goal::LeastDistance {
                self.record_upper_bound(&pair, &outcome);
            }
            return self.decide_halves(&pair, splits - 1);
        }
        Ok(match self.goal {
            Goal::AnyContact | Goal::FirstContact => self.record_contact_answer(&pair, &outcome),
            Goal::LeastDistance => self.record_distance(&pair, &outcome),
        })
    }

    /// Lets the engine decide about both halves of an candidate pair's interval.
    fn decide_halves(&mut self, pair: &EngineCandidate, splits: u32) -> StepResult {
        for half in pair.halves() {
            if self.decide_pair(half, splits)?.is_break() {
                return Ok(Break(()));
            }
        }
        Ok(Continue(()))
    }

    /// Keeps an answer about contacts of an candidate pair.
    fn record_contact_answer(
        &mut self,
        candidate: &EngineCandidate,
        outcome: &Outcome,
    ) -> ControlFlow<()> {
        match outcome.hit() {
            Ok(None) => Continue(()),
            Ok(Some(hit)) => {
                let at = candidate.point(hit.time);
                if at <= self.result.end {
                    self.result.limit_reached = None;
                }
                let beyond = self.distance_beyond_margin(&candidate.pair, outcome);
                self.record_contact(&candidate.pair, at, beyond)
            }
            Err(known) => {
                let until = match self.goal {
                    Goal::FirstContact => candidate.point(known.safe_until),
                    _ => 0.0,
                };
                self.result.limit_reached = Some((known.limit, until));
                if self.goal == Goal::FirstContact {
                    self.result.end = until;
                }
                Continue(())
            }
        }
    }

    /// Bounds how far beyond its margin a pair in contact is. The engine gets rounded positions.
    fn distance_beyond_margin(&self, pair: &PartPair, contact: &Outcome) -> f64 {
        let rounding = 2.0 * self.placement.rounding;
        (contact.upper() + rounding - pair.margin).next_up()
    }

    /// Returns whether an candidate pair stays farther apart than what is found, but for the tolerance.
    fn is_no_nearer(&mut self, candidate: &EngineCandidate) -> Result<bool, Error> {
        let least = self.result.distance_upper_bound - self.tolerance;
        if !(least < f64::INFINITY) {
            return Ok(false);
        }
        let answer = self.query_engine(Goal::LeastDistance, candidate, Some(least))?;
        let required = least + self.allowance(candidate);
        Ok(answer.outcome.clearance_verdict(required) == ClearanceVerdict::Kept)
    }

    /// Keeps the distance of an candidate pair, if it is the least.
    fn record_distance(
        &mut self,
        candidate: &EngineCandidate,
        outcome: &Outcome,
    ) -> ControlFlow<()> {
        if let Some(limit) = outcome.limit() {
            self.result.limit_reached = Some((limit, 0.0));
        }
        // The bounds of bodies that exceed their shapes may differ by more than the tolerance.
        let lower = outcome.lower() - self.allowance(candidate);
        self.result.lower = lesser(self.result.lower, lower);
        self.record_upper_bound(candidate, outcome);
        if outcome.upper() > 0.0 {
            Continue(())
        } else {
            Break(())
        }
    }

    /// Keeps the upper bound of the distance of an candidate pair, if it is the least.
    fn record_upper_bound(&mut self, candidate: &EngineCandidate, outcome: &Outcome) {
        let upper = outcome.upper() + 2.0 * self.placement.rounding;
        if upper < self.result.distance_upper_bound {
            let at = candidate.point(outcome.time().unwrap_or(0.0));
            self.record_nearest(&candidate.pair, at, upper);
        }
    }

    /// Bounds how much nearer a pair may be than the engine finds it: the engine gets rounded positions, and a period may stand for
    /// others.
    fn allowance(&self, candidate: &EngineCandidate) -> f64 {
        2.0 * self.placement.rounding + self.drift(candidate)
    }

    /// Asks the engine about an candidate pair. Its margin or clearance is larger by the allowance.
    fn query_engine(
        &mut self,
        goal: Goal,
        candidate: &EngineCandidate,
        clearance: Option<f64>,
    ) -> Result<Answer, Error> {
        let allowance = self.allowance(candidate);
        self.solver.set_settings(Settings {
            // A drift is at most a share of the tolerance.
            tolerance: self.tolerance - self.drift(candidate),
            margin: candidate.pair.margin + allowance,
            clearance: clearance.map(|clearance| greater(clearance + allowance, 0.0)),
            budget: self.stop_condition.budget_of_query(),
            start_policy: StartPolicy::Report,
            deadline: self.stop_condition.remaining(),
            contact_normals: ContactNormals::OfPieces,
            ..self.settings.clone()
        });
        let section = PathSection {
            path: &self.path,
            segment: candidate.segment,
            from: candidate.from,
            to: candidate.to,
        };
        let answer = self
            .exact_chains
            .ask(&mut self.solver, goal, candidate.bodies, &section)?;
        // A query is a step, even if bounding volumes decide it.
        self.stop_condition
            .add_work(1 + answer.stats.budgeted_work());
        Ok(answer)
    }
}
