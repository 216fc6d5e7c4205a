//! Searches for the least distance of two bodies over a duration, pair by pair.

use super::follow::follow_to_minimum;
use super::ladder::{LowerBoundAttempts, MAX_FINAL_ATTEMPTS, MarginQuery};
use super::{FartherThanCutoff, NearestPair};
use crate::answer::{Limit, Outcome, Unresolved};
use crate::distance::oracle::DistanceOracle;
use crate::engine::closer_look::BoundTightener;
use crate::engine::meter::Meter;
use crate::engine::nodes::common::NodeContext;
use crate::engine::pieces::contact_rule::PairStep;
use crate::engine::proven::ProvenFacts;
use crate::engine::search::{AdvanceResult, Search, SearchHandler};
use crate::engine::start::overlap_outcome;
use crate::math::order::lesser;
use crate::motion::free_time::FreeTime;
use crate::problem::Problem;
use crate::questions::depth_first::Stack;
use std::ops::ControlFlow;

/// A search for the least distance, which proves that each pair stays at least as far apart as the least distance found
/// so far.
pub(crate) struct LeastDistanceSearch {
    pub(crate) nearest_pair: Option<NearestPair>,
    /// The distance from which on pairs are ignored.
    pub(crate) cutoff_distance: f64,
    pub(crate) proven_facts: ProvenFacts,
    /// The reason why some pair could not be proven apart to the end; `None` if there is no such pair.
    pub(crate) first_failure: Option<Limit>,
    /// The lower bound of the distance that is proven for all pairs, with the state of further attempts.
    pub(crate) lower_bound_attempts: LowerBoundAttempts,
}

impl LeastDistanceSearch {
    pub(crate) fn upper(&self) -> f64 {
        let upper = |best: NearestPair| best.contact.separation.upper;
        self.nearest_pair.map_or(self.cutoff_distance, upper)
    }

    pub(crate) fn least_distance_outcome(
        &self,
        problem: &Problem<'_>,
        lower: f64,
    ) -> Result<Outcome, FartherThanCutoff> {
        let best = self.nearest_pair.ok_or(FartherThanCutoff { lower })?;
        let (time, contact) = best.time_and_contact(problem, lower);
        Ok(Outcome::LeastDistance {
            lower,
            time,
            contact,
        })
    }

    pub(crate) fn unresolved_outcome(&self, problem: &Problem<'_>, limit: Limit) -> Outcome {
        let lower = lesser(self.lower_bound_attempts.lower, self.upper());
        let seen = self.nearest_pair;
        let seen = seen.map(|best| best.time_and_contact(problem, lower));
        Outcome::Unresolved(Unresolved::for_least_distance(lower, seen, limit))
    }

    /// Tries to prove a lower bound in a separate search, and records the bound or the nearer pieces that the search
    /// finds.
    ///
    /// Breaks with the answer for bodies that overlap.
    pub(crate) fn try_lower_bound<O: DistanceOracle>(
        &mut self,
        problem: &Problem<'_>,
        attempt: MarginQuery,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ControlFlow<Outcome> {
        let work = meter.stats.budgeted_work();
        let budget = problem.budget.min(work.saturating_add(attempt.budget));
        let lower = MarginQuery { budget, ..attempt }.problem(problem);
        let mut below = LeastDistanceSearch {
            nearest_pair: None,
            cutoff_distance: lower.contact_distance(),
            proven_facts: ProvenFacts::default(),
            first_failure: None,
            lower_bound_attempts: LowerBoundAttempts::new(0.0, 0),
        };
        let mut stack = Stack::default();
        let mut search = Search::new(&mut stack, oracle, meter);
        let common = NodeContext::new(&lower);
        let mut look = BoundTightener::new(&lower);
        let mut found = None;
        if search.push_roots(&lower).is_ok() {
            while below.nearest_pair.is_none() && found.is_none() {
                found = search
                    .visit_next_pair(&common, &mut look, &mut below)
                    .break_value();
            }
        }
        match found {
            Some(Ok(overlapping @ Outcome::Overlapping { .. })) => {
                return ControlFlow::Break(overlapping);
            }
            Some(Err(FartherThanCutoff { lower })) => {
                self.lower_bound_attempts.record_attempt(Some(lower));
            }
            _ => self.lower_bound_attempts.record_attempt(None),
        }
        if let Some(best) = below
            .nearest_pair
            .filter(|best| best.contact.separation.upper < self.upper())
        {
            self.nearest_pair = Some(best);
        }
        ControlFlow::Continue(())
    }

    /// Returns the outcome of the search. If some pair could not be proven apart to the end, it first tries to prove
    /// further lower bounds.
    pub(crate) fn final_outcome<O: DistanceOracle>(
        &mut self,
        problem: &Problem<'_>,
        found: Result<Outcome, FartherThanCutoff>,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Result<Outcome, FartherThanCutoff> {
        let limit = match (&found, self.first_failure) {
            (Ok(Outcome::Unresolved(known)), Some(_)) => known.limit,
            _ => return found,
        };
        for _ in 0..MAX_FINAL_ATTEMPTS {
            let left = problem.budget.saturating_sub(meter.stats.budgeted_work());
            let Some(attempt) = self
                .lower_bound_attempts
                .next_attempt(self.upper(), left / 2)
            else {
                break;
            };
            if let ControlFlow::Break(found) = self.try_lower_bound(problem, attempt, oracle, meter)
            {
                return Ok(found);
            }
        }
        Ok(self.unresolved_outcome(problem, limit))
    }
}

impl<O: DistanceOracle> SearchHandler<O> for LeastDistanceSearch {
    type Conclusion = Result<Outcome, FartherThanCutoff>;

    fn on_advance(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        advance: AdvanceResult,
    ) -> ControlFlow<Self::Conclusion, FreeTime> {
        match advance.step_outcome {
            PairStep::Free(free) => ControlFlow::Continue(free),
            PairStep::Contact(contact) => {
                let seen = NearestPair {
                    time: advance.clock,
                    pieces: advance.piece_pair,
                    contact,
                };
                self.nearest_pair = Some(follow_to_minimum(problem, oracle, meter, seen));
                // The pair is examined again, since it keeps a smaller distance.
                ControlFlow::Continue(FreeTime::NONE)
            }
            PairStep::Overlap(contact) => ControlFlow::Break(Ok(overlap_outcome(contact))),
            PairStep::Stalled => {
                self.first_failure = Some(Limit::Stalled);
                ControlFlow::Continue(FreeTime::ToEnd)
            }
            PairStep::GaveUp => {
                self.first_failure = Some(Limit::OracleGaveUp);
                ControlFlow::Continue(FreeTime::ToEnd)
            }
        }
    }

    fn on_limit(&mut self, problem: &Problem<'_>, _: f64, limit: Limit) -> Self::Conclusion {
        Ok(self.unresolved_outcome(problem, limit))
    }

    fn on_end(&mut self, problem: &Problem<'_>) -> Self::Conclusion {
        if let Some(limit) = self.first_failure {
            return Ok(self.unresolved_outcome(problem, limit));
        }
        match self.proven_facts.final_outcome(problem) {
            overlapping @ Outcome::Overlapping { .. } => Ok(overlapping),
            Outcome::Free { proven_gap } => self.least_distance_outcome(problem, proven_gap),
            Outcome::Unresolved(known) => Ok(self.unresolved_outcome(problem, known.limit)),
            _ => unreachable!("pairs that waited are in no contact"),
        }
    }
}
