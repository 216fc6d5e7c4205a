//! Decides whether bodies keep a required distance, by queries for any contact. The required distance is the margin of
//! the first query. A second query has a smaller margin, to prove a violation.

use super::ladder::{LowerBoundAttempts, MAX_FINAL_ATTEMPTS, MarginQuery};
use crate::answer::{Answer, Contact, Limit, Outcome, Stats, Unresolved};
use crate::body::excess::ExcessSum;
use crate::limits::LEAST_TOLERANCE;
use crate::math::order::{greater, lesser};
use std::time::{Duration, Instant};

/// A required distance, and the tolerance and budget of the decision.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RequiredClearance {
    pub(crate) distance: f64,
    pub(crate) tolerance: f64,
    pub(crate) budget: u64,
    pub(crate) deadline: Option<Duration>,
    /// The excess of the bodies over their shapes. The shapes certainly violate the distance only if the bodies are
    /// nearer than it by the excess.
    pub(crate) body_excess: ExcessSum,
}

impl RequiredClearance {
    /// Decides whether the bodies keep the required distance, by calls of `any_contact` with the remaining time to the
    /// deadline. The first query asks whether the bodies come near the distance. If they do, the second asks whether
    /// they come nearer by the excess. In between, neither answer is certain for the shapes.
    ///
    /// # Errors
    /// The errors of the query for any contact.
    pub(crate) fn decide<E>(
        &self,
        any_contact: impl FnMut(MarginQuery, Option<Duration>) -> Result<Answer, E>,
    ) -> Result<Answer, E> {
        let mut decision = ClearanceDecision {
            clearance: *self,
            answer_any_contact: any_contact,
            start_and_time_limit: self.deadline.map(|deadline| (Instant::now(), deadline)),
            stats: Stats::default(),
            query_tolerance: 0.5 * self.tolerance,
        };
        // A part of the budget is left for the proof of a smaller distance.
        let near = decision.run_query(MarginQuery {
            margin: self.distance,
            tolerance: decision.query_tolerance,
            budget: self.budget - self.budget / 4,
        })?;
        // A finer tolerance may not be certified in f64.
        decision.query_tolerance = greater(decision.query_tolerance, near.tolerance);
        let mut outcome = match self.clearance_outcome(near.outcome) {
            Outcome::LeastDistance { time, contact, .. } if self.violation_distance() > 0.0 => {
                decision.decide_violation(time, contact)?
            }
            found => found,
        };
        if let Outcome::Unresolved(known) = &mut outcome {
            known.lower = decision.prove_lower_bound(known.limit)?;
        }
        Ok(Answer {
            tolerance: greater(self.tolerance, outcome.least_distance_bracket_width()),
            outcome,
            stats: decision.stats,
        })
    }

    /// Returns the distance of bodies below which their shapes are certainly nearer than the required distance. It is 0
    /// or less if there is none.
    fn violation_distance(&self) -> f64 {
        self.body_excess.certain_nearness_threshold(self.distance)
    }

    /// Converts the outcome of a query whose margin is the required distance to the outcome of the decision.
    fn clearance_outcome(&self, found: Outcome) -> Outcome {
        match found {
            Outcome::Free { proven_gap } => Outcome::Free {
                proven_gap: greater(proven_gap, self.distance),
            },
            Outcome::Contact { time, contact } => {
                let upper = contact.separation.upper;
                if self.body_excess.shape_distance_upper_bound(upper) < self.distance {
                    found
                } else {
                    Outcome::from_least_distance(0.0, time, contact)
                }
            }
            Outcome::Unresolved(known) => {
                Outcome::Unresolved(Unresolved::for_least_distance(0.0, None, known.limit))
            }
            found => found,
        }
    }
}

/// The state of a decision about a required clearance, with the work spent so far.
struct ClearanceDecision<F> {
    clearance: RequiredClearance,
    answer_any_contact: F,
    /// The time at which the decision started, and the longest time that it may take; `None` if there is no deadline.
    start_and_time_limit: Option<(Instant, Duration)>,
    stats: Stats,
    /// The tolerance of each query: half the tolerance of the answer.
    query_tolerance: f64,
}

impl<E, F: FnMut(MarginQuery, Option<Duration>) -> Result<Answer, E>> ClearanceDecision<F> {
    fn run_query(&mut self, mut margin_query: MarginQuery) -> Result<Answer, E> {
        margin_query.tolerance = greater(LEAST_TOLERANCE, margin_query.tolerance);
        let left =
            |(begun, deadline): (Instant, Duration)| deadline.saturating_sub(begun.elapsed());
        let answer = (self.answer_any_contact)(margin_query, self.start_and_time_limit.map(left))?;
        self.stats.add(&answer.stats);
        Ok(answer)
    }

    /// Returns the budget less the work of the queries so far.
    fn remaining_budget(&self) -> u64 {
        self.clearance
            .budget
            .saturating_sub(self.stats.budgeted_work())
    }

    /// Runs the second query, which asks whether the bodies come nearer than the distance by more than the excess.
    /// `contact` at `time` is the result of the first query, which found that they come near the distance.
    fn decide_violation(&mut self, time: f64, contact: Contact) -> Result<Outcome, E> {
        let (distance, query_tolerance) =
            (self.clearance.violation_distance(), self.query_tolerance);
        // Bodies in contact with this margin are nearer. Bodies that are not keep the distance up to the tolerance
        // and the excess.
        let margin = greater(0.0, distance - 1.5 * query_tolerance);
        let margin_query = MarginQuery {
            margin,
            tolerance: if margin > 0.0 {
                query_tolerance
            } else {
                lesser(query_tolerance, 0.5 * distance)
            },
            budget: self.remaining_budget(),
        };
        let found = self.run_query(margin_query)?.outcome;
        Ok(match (found, self.clearance.clearance_outcome(found)) {
            (Outcome::Free { proven_gap }, _) => {
                Outcome::from_least_distance(proven_gap, time, contact)
            }
            (_, Outcome::Unresolved(known)) => Outcome::Unresolved(Unresolved::for_least_distance(
                known.lower,
                Some((time, contact)),
                known.limit,
            )),
            (_, found) => found,
        })
    }

    /// Proves a lower bound of the distance with the rest of the budget, in several attempts; 0 if none succeeds.
    fn prove_lower_bound(&mut self, reason: Limit) -> Result<f64, E> {
        let mut attempts = LowerBoundAttempts::new(0.0, self.clearance.budget);
        if matches!(reason, Limit::Deadline | Limit::Stopped) {
            return Ok(attempts.lower);
        }
        for _ in 0..MAX_FINAL_ATTEMPTS {
            let Some(attempt) =
                attempts.next_attempt(self.clearance.distance, self.remaining_budget() / 2)
            else {
                break;
            };
            attempts.record_attempt(match self.run_query(attempt)?.outcome {
                Outcome::Free { proven_gap } => Some(proven_gap),
                _ => None,
            });
        }
        Ok(attempts.lower)
    }
}
