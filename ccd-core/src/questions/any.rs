//! Decides whether two bodies touch at all. The search need not go in order of time.

use crate::answer::{Answer, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::answer_by_unordered_search;
use crate::engine::meter::Meter;
use crate::engine::pieces::contact_rule::PairStep;
use crate::engine::proven::ProvenFacts;
use crate::engine::search::{AdvanceResult, Search, SearchHandler};
use crate::engine::shortcuts::bounding_volumes::free_outcome_by_bounding_volumes;
use crate::engine::start::overlap_outcome;
use crate::error::InputError;
use crate::math::order::lesser;
use crate::motion::free_time::FreeTime;
use crate::problem::Problem;
use crate::query::Query;
use crate::questions::depth_first::DepthFirst;
use std::ops::ControlFlow;

impl<O: DistanceOracle> DepthFirst<O> {
    /// Decides whether the bodies touch at all: whether they come within margin + tolerance.
    ///
    /// The verdict is that of the first contact, up to near misses within the tolerance. It costs as
    /// much for bodies that stay apart, and less for others: pairs are followed to a contact without
    /// regard to those that may touch before.
    ///
    /// # Guarantee
    /// The guarantee of [`Outcome`]; ends on every input; the same call gives the same bits, unless a
    /// [deadline](crate::Settings::deadline) ends it.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn any_contact(&mut self, query: &Query<'_>, oracle: &mut O) -> Result<Answer, InputError> {
        match &query.constant_velocity_problem {
            Some(problem) => Ok(self.any_contact_of(problem, oracle)),
            None => self.any_contact_along(query, oracle),
        }
    }

    /// Decides whether the bodies of a problem touch at all within its duration.
    pub(crate) fn any_contact_of(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        let mut scratch = self.scratch.take();
        let answer =
            answer_by_unordered_search(problem, oracle, &mut scratch, |problem, oracle, meter| {
                self.stack.clear();
                let outcome = self.search_any_contact(problem, oracle, meter);
                let stats = &mut meter.stats;
                stats.peak_front = stats.peak_front.max(self.stack.peak_length());
                outcome
            });
        self.stack.clear();
        self.scratch = scratch;
        touching_as_contact(answer)
    }

    fn search_any_contact(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Outcome {
        if let Some(free) = free_outcome_by_bounding_volumes(problem) {
            return free;
        }
        let mut search = Search::new(&mut self.stack, oracle, meter);
        let mut any = AnyContactSearch::default();
        match search.run(problem, &mut any) {
            Outcome::Unresolved(known) => {
                // Waiting pairs are proven apart only until their clocks.
                let time = lesser(
                    known.safe_until,
                    problem.time_of_clock(self.stack.least_clock()),
                );
                let unresolved = Outcome::unresolved(time, known.limit);
                // Surfaces that are apart at the start do not exclude that one body is inside the other.
                if time > problem.time_of_clock(0.0) {
                    any.proven_facts
                        .check_containment_once_apart(problem)
                        .unwrap_or(unresolved)
                } else {
                    unresolved
                }
            }
            outcome => outcome,
        }
    }
}

/// Returns the answer with a contact at the start reported as a contact at time 0; other answers are unchanged.
pub(crate) fn touching_as_contact(mut answer: Answer) -> Answer {
    if let Outcome::Touching { contact } = answer.outcome {
        answer.outcome = Outcome::Contact { time: 0.0, contact };
    }
    answer
}

/// A search for any contact of two bodies, with what it has proven so far.
#[derive(Default)]
struct AnyContactSearch {
    proven_facts: ProvenFacts,
    /// The earliest clock of a pair that could not be proven apart to the end, and the limit that stopped the proof.
    first_unproven_clock: Option<(f64, Limit)>,
}

impl AnyContactSearch {
    /// Drops a pair that cannot be proven apart any further, and records its clock; the search goes on, since another
    /// pair may be in contact.
    fn give_up_pair(&mut self, s: f64, limit: Limit) -> ControlFlow<Outcome, FreeTime> {
        if self.first_unproven_clock.is_none_or(|(first, _)| s < first) {
            self.first_unproven_clock = Some((s, limit));
        }
        ControlFlow::Continue(FreeTime::ToEnd)
    }

    fn unresolved_outcome(&self, problem: &Problem<'_>, s: f64, reason: Limit) -> Outcome {
        let first_failure = self
            .first_unproven_clock
            .map_or(f64::INFINITY, |(first, _)| first);
        Outcome::unresolved(problem.time_of_clock(lesser(s, first_failure)), reason)
    }
}

impl<O: DistanceOracle> SearchHandler<O> for AnyContactSearch {
    type Conclusion = Outcome;

    fn on_advance(
        &mut self,
        problem: &Problem<'_>,
        _: &mut O,
        _: &mut Meter,
        advance: AdvanceResult,
    ) -> ControlFlow<Outcome, FreeTime> {
        let AdvanceResult {
            clock: s,
            step_outcome: step,
            ..
        } = advance;
        ControlFlow::Break(match step {
            PairStep::Free(free) => return ControlFlow::Continue(free),
            // A pair that keeps its distance gives no bound for the other pairs.
            PairStep::Contact(contact) => Outcome::Contact {
                time: problem.time_of_clock(s),
                contact: contact.cap_lower_bound(0.0),
            },
            PairStep::Overlap(contact) => overlap_outcome(contact),
            PairStep::Stalled => return self.give_up_pair(s, Limit::Stalled),
            PairStep::GaveUp => return self.give_up_pair(s, Limit::OracleGaveUp),
        })
    }

    fn on_limit(&mut self, problem: &Problem<'_>, s: f64, limit: Limit) -> Outcome {
        self.unresolved_outcome(problem, s, limit)
    }

    fn on_end(&mut self, problem: &Problem<'_>) -> Outcome {
        match self.first_unproven_clock {
            Some((s, limit)) => self.unresolved_outcome(problem, s, limit),
            None => self.proven_facts.final_outcome(problem),
        }
    }
}

#[cfg(test)]
mod tests;
