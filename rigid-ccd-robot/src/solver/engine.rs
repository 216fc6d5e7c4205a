//! Queries of the engine: for non-convex bodies, and for candidate pairs that halving does not decide.

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
    /// Queries the engine about each non-convex candidate at the midpoint of an interval.
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
            // A contact before the midpoint makes the other pairs at the midpoint irrelevant.
            if !matches!(step, Ok(Continue(()))) || self.result.end <= at {
                break;
            }
        }
        self.nonconvex_candidates = candidates;
        step
    }

    pub(super) fn check_nonconvex_candidate(
        &mut self,
        pair: &PartPair,
        bodies: [usize; 2],
        at: f64,
    ) -> StepResult {
        let goal = match self.goal {
            Goal::FirstContact => Goal::AnyContact,
            other => other,
        };
        let candidate = EngineCandidate::new_at_point(*pair, bodies, (at, self.segment_count()));
        let answer = self.query_engine(goal, &candidate, None)?;
        if goal == Goal::LeastDistance {
            return Ok(self.record_distance(&candidate, &answer.outcome));
        }
        // A pair that is undecided because of a limit stays a candidate.
        Ok(match answer.outcome.hit() {
            Ok(Some(_)) => {
                let beyond = self.distance_beyond_margin(pair, &answer.outcome);
                self.record_contact(pair, at, beyond)
            }
            Ok(None) | Err(_) => Continue(()),
        })
    }

    /// Queries the engine about all remaining candidates.
    pub(super) fn decide_engine_candidates(&mut self) -> Result<(), Error> {
        let mut candidates = std::mem::take(&mut self.engine_candidates);
        let result = self.decide(candidates.sorted_for(self.goal));
        self.engine_candidates = candidates;
        result
    }

    fn decide(&mut self, candidates: &[EngineCandidate]) -> Result<(), Error> {
        for candidate in candidates {
            if candidate.from >= self.result.end {
                continue;
            }
            if let Some(limit) = self.stop_condition.reached_limit() {
                // For the first contact, candidates are sorted by their starts: all earlier ones are decided.
                let until = match self.goal {
                    Goal::FirstContact => candidate.from,
                    Goal::AnyContact | Goal::LeastDistance => 0.0,
                };
                self.result.limit_reached = Some((limit, until));
                self.result.lower = 0.0;
                break;
            }
            if self
                .decide_candidate(*candidate, MAX_BUDGET_SPLITS)?
                .is_break()
            {
                break;
            }
        }
        Ok(())
    }

    /// Decides one candidate with the engine. If the budget of a query does not suffice, its interval is halved, up to
    /// `splits` times and while the question has budget left.
    fn decide_candidate(&mut self, mut candidate: EngineCandidate, splits: u32) -> StepResult {
        if candidate.from >= self.result.end {
            return Ok(Continue(()));
        }
        candidate.to = lesser(candidate.to, self.result.end);
        // A pair may approach many times within a period, so one budget is unlikely to suffice.
        if splits > 0 && self.drift(&candidate) > 0.0 {
            return self.decide_halves(&candidate, splits - 1);
        }
        if self.goal == Goal::LeastDistance {
            // The least distance so far is within the tolerance of 0. Written so that a NaN is measured.
            if self.result.distance_upper_bound - self.tolerance <= 0.0 {
                return Ok(Break(()));
            }
            if self.is_no_nearer(&candidate)? {
                return Ok(Continue(()));
            }
        }
        let outcome = self.query_engine(self.goal, &candidate, None)?.outcome;
        let is_budget_spent = outcome.limit() == Some(Limit::Budget);
        if is_budget_spent && splits > 0 && self.stop_condition.reached_limit().is_none() {
            if self.goal == Goal::LeastDistance {
                self.record_upper_bound(&candidate, &outcome);
            }
            return self.decide_halves(&candidate, splits - 1);
        }
        Ok(match self.goal {
            Goal::AnyContact | Goal::FirstContact => {
                self.record_contact_answer(&candidate, &outcome)
            }
            Goal::LeastDistance => self.record_distance(&candidate, &outcome),
        })
    }

    /// Decides both halves of a candidate's interval.
    fn decide_halves(&mut self, candidate: &EngineCandidate, splits: u32) -> StepResult {
        for half in candidate.halves() {
            if self.decide_candidate(half, splits)?.is_break() {
                return Ok(Break(()));
            }
        }
        Ok(Continue(()))
    }

    /// Records the engine's answer to a question about contacts.
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

    /// Bounds the distance beyond the margin of a pair in contact. The engine works with rounded positions.
    fn distance_beyond_margin(&self, pair: &PartPair, contact: &Outcome) -> f64 {
        let rounding = 2.0 * self.placement.rounding;
        (contact.upper() + rounding - pair.margin).next_up()
    }

    /// Returns whether a candidate is proven to stay farther apart than the least distance so far minus the tolerance.
    fn is_no_nearer(&mut self, candidate: &EngineCandidate) -> Result<bool, Error> {
        let least = self.result.distance_upper_bound - self.tolerance;
        if !(least < f64::INFINITY) {
            return Ok(false);
        }
        let answer = self.query_engine(Goal::LeastDistance, candidate, Some(least))?;
        let required = least + self.allowance(candidate);
        Ok(answer.outcome.clearance_verdict(required) == ClearanceVerdict::Kept)
    }

    /// Records the bounds of a candidate's distance, if they are lower than the bounds so far.
    fn record_distance(
        &mut self,
        candidate: &EngineCandidate,
        outcome: &Outcome,
    ) -> ControlFlow<()> {
        if let Some(limit) = outcome.limit() {
            self.result.limit_reached = Some((limit, 0.0));
        }
        // If bodies exceed their shapes, both bounds may differ by more than the tolerance.
        let lower = outcome.lower() - self.allowance(candidate);
        self.result.lower = lesser(self.result.lower, lower);
        self.record_upper_bound(candidate, outcome);
        if outcome.upper() > 0.0 {
            Continue(())
        } else {
            Break(())
        }
    }

    /// Records the upper bound of a candidate's distance, if it is the least.
    fn record_upper_bound(&mut self, candidate: &EngineCandidate, outcome: &Outcome) {
        let upper = outcome.upper() + 2.0 * self.placement.rounding;
        if upper < self.result.distance_upper_bound {
            let at = candidate.point(outcome.time().unwrap_or(0.0));
            self.record_nearest(&candidate.pair, at, upper);
        }
    }

    /// Bounds how much nearer a candidate may be than the engine reports, because positions are rounded and the searched
    /// period represents later periods.
    fn allowance(&self, candidate: &EngineCandidate) -> f64 {
        2.0 * self.placement.rounding + self.drift(candidate)
    }

    /// Queries the engine about a candidate. Its margin or clearance is enlarged by [`PathSearch::allowance`].
    fn query_engine(
        &mut self,
        goal: Goal,
        candidate: &EngineCandidate,
        clearance: Option<f64>,
    ) -> Result<Answer, Error> {
        let allowance = self.allowance(candidate);
        self.solver.set_settings(Settings {
            // A drift is at most a fraction of the tolerance.
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
            .query(&mut self.solver, goal, candidate.bodies, &section)?;
        // Counts each query as work, even if bounding volumes decide it.
        self.stop_condition
            .add_work(1 + answer.stats.budgeted_work());
        Ok(answer)
    }
}
