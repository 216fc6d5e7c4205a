//! Do two bodies touch at all? Any contact will do: the search need not go in the order of time.

use super::answer::answer_in_any_order;
use super::depth_first::DepthFirst;
use super::meter::Meter;
use super::pieces::pair::Step;
use super::proven::{Proven, free_at_once};
use super::rounds::in_rounds;
use super::search::{Advance, Question, Search};
use super::start::overlapping;
use crate::distance::oracle::DistanceOracle;
use crate::math::order::lesser;
use crate::outcome::{Answer, Contact, Limit, Outcome, Overlap};
use crate::problem::Problem;
use std::ops::ControlFlow;

/// The answer to "do they touch at all?".
///
/// # Guarantee
/// Bodies that are [free](AnyContact::Free) never touch, in floating point as well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyContact {
    /// The bodies stay apart over the whole duration.
    Free {
        /// As in [`Outcome::Free`].
        proven_gap: f64,
    },
    /// The bodies are within margin + tolerance at `time`. They may be so before, and may overlap then.
    Contact {
        /// The time, in the motions' unit.
        time: f64,
        /// Two pieces that are in contact at that time.
        contact: Contact,
    },
    /// The bodies overlap at the start.
    Overlapping {
        /// The proof.
        overlap: Overlap,
    },
    /// A limit was reached before an answer.
    Unresolved {
        /// The bodies do not touch before this time, certified.
        safe_until: f64,
        /// The limit.
        reason: Limit,
    },
}

impl From<Outcome> for AnyContact {
    /// Forgets that a first contact is the first.
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Free { proven_gap } => AnyContact::Free { proven_gap },
            Outcome::Contact { time, contact } => AnyContact::Contact { time, contact },
            Outcome::Touching { contact } => AnyContact::Contact { time: 0.0, contact },
            Outcome::Overlapping { overlap } => AnyContact::Overlapping { overlap },
            Outcome::Unresolved { safe_until, reason } => {
                AnyContact::Unresolved { safe_until, reason }
            }
        }
    }
}

impl<O: DistanceOracle> DepthFirst<O> {
    /// Answers whether the bodies touch at all, or come within margin + tolerance.
    ///
    /// The verdict is that of the first contact, up to near misses within the tolerance. It costs as
    /// much for bodies that stay apart, and less for others: pairs are followed to a contact without
    /// regard to those that may touch before.
    ///
    /// # Guarantee
    /// That of [`AnyContact`]; ends on every input; the same call gives the same bits, unless a
    /// [deadline](crate::Config::deadline) ends it.
    pub fn any_contact(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer<AnyContact> {
        let mut kept = self.kept.take();
        let answer = answer_in_any_order(problem, oracle, &mut kept, |problem, oracle, meter| {
            in_rounds(problem, meter, |problem, meter| {
                self.stack.clear();
                let outcome = self.contact(problem, oracle, meter);
                let stats = &mut meter.stats;
                stats.peak_front = stats.peak_front.max(self.stack.peak());
                outcome
            })
        });
        self.stack.clear();
        self.kept = kept;
        answer.map(AnyContact::from)
    }

    fn contact(&mut self, problem: &Problem<'_>, oracle: &mut O, meter: &mut Meter) -> Outcome {
        if let Some(free) = free_at_once(problem) {
            return free;
        }
        let mut search = Search {
            waiting: &mut self.stack,
            oracle,
            meter,
        };
        let mut any = Any::default();
        match search.run(problem, &mut any) {
            // Pairs that still wait keep apart until their clocks only.
            Outcome::Unresolved { safe_until, reason } => Outcome::Unresolved {
                safe_until: lesser(safe_until, problem.time(self.stack.least_clock())),
                reason,
            },
            outcome => outcome,
        }
    }
}

/// Do they touch at all?
#[derive(Default)]
struct Any {
    proven: Proven,
    /// The clock of the first pair that could not be proven further, and the reason.
    stuck: Option<(f64, Limit)>,
}

impl Any {
    /// Leaves a pair alone that cannot be proven further: another one may be in contact.
    fn leave(&mut self, s: f64, limit: Limit) -> ControlFlow<Outcome, f64> {
        if self.stuck.is_none_or(|(first, _)| s < first) {
            self.stuck = Some((s, limit));
        }
        ControlFlow::Continue(f64::INFINITY)
    }

    fn unresolved(&self, problem: &Problem<'_>, s: f64, reason: Limit) -> Outcome {
        let stuck = self.stuck.map_or(f64::INFINITY, |(first, _)| first);
        Outcome::Unresolved {
            safe_until: problem.time(lesser(s, stuck)),
            reason,
        }
    }
}

impl<O: DistanceOracle> Question<O> for Any {
    type Found = Outcome;

    fn conclude(
        &mut self,
        problem: &Problem<'_>,
        _: &mut O,
        _: &mut Meter,
        advance: Advance,
    ) -> ControlFlow<Outcome, f64> {
        let Advance { clock: s, step, .. } = advance;
        ControlFlow::Break(match step {
            Step::FreeUntil(clock) => return ControlFlow::Continue(clock),
            // A pair that keeps its distance bounds none of the others.
            Step::Contact(contact) => Outcome::Contact {
                time: problem.time(s),
                contact: contact.no_nearer_than(0.0),
            },
            Step::Overlap(contact) => overlapping(contact),
            Step::Stalled => return self.leave(s, Limit::Stalled),
            Step::GaveUp => return self.leave(s, Limit::OracleGaveUp),
        })
    }

    fn stopped(&mut self, problem: &Problem<'_>, s: f64, limit: Limit) -> Outcome {
        self.unresolved(problem, s, limit)
    }

    fn done(&mut self, problem: &Problem<'_>) -> Outcome {
        match self.stuck {
            Some((s, limit)) => self.unresolved(problem, s, limit),
            None => self.proven.end(problem),
        }
    }
}

#[cfg(test)]
mod tests;
