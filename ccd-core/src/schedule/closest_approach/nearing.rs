//! The search for the least distance.

use super::follow::follow;
use super::{Best, Beyond, ClosestApproach};
use crate::distance::oracle::DistanceOracle;
use crate::outcome::{Limit, Outcome, Overlap};
use crate::problem::Problem;
use crate::schedule::meter::Meter;
use crate::schedule::pieces::pair::Step;
use crate::schedule::proven::Proven;
use crate::schedule::search::{Advance, Question};
use std::ops::ControlFlow;

/// How close do they come? Pairs are proven to keep the least distance found so far.
pub(super) struct Nearing {
    pub(super) best: Option<Best>,
    /// Larger distances are of no interest.
    pub(super) beyond: f64,
    pub(super) proven: Proven,
    /// The reason why some pair could not be proven to the end.
    pub(super) stuck: Option<Limit>,
}

impl Nearing {
    pub(super) fn upper(&self) -> f64 {
        let upper = |best: Best| best.contact.separation.upper;
        self.best.map_or(self.beyond, upper)
    }

    pub(super) fn found(
        &self,
        problem: &Problem<'_>,
        lower: f64,
    ) -> Result<ClosestApproach, Beyond> {
        let best = self.best.ok_or(Beyond { lower })?;
        Ok(ClosestApproach::Nearest {
            lower,
            time: problem.time(best.clock),
            contact: best.contact.no_nearer_than(lower),
        })
    }

    pub(super) fn unresolved(&self, problem: &Problem<'_>, reason: Limit) -> ClosestApproach {
        let seen = |best: Best| {
            let contact = best.contact.no_nearer_than(0.0);
            (problem.time(best.clock), contact)
        };
        ClosestApproach::Unresolved {
            nearest: self.best.map(seen),
            reason,
        }
    }
}

impl<O: DistanceOracle> Question<O> for Nearing {
    type Found = Result<ClosestApproach, Beyond>;

    fn conclude(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        advance: Advance,
    ) -> ControlFlow<Self::Found, f64> {
        let Advance {
            pieces,
            clock,
            step,
        } = advance;
        match step {
            Step::FreeUntil(clock) => ControlFlow::Continue(clock),
            Step::Contact(contact) => {
                let seen = Best {
                    clock,
                    pieces,
                    contact,
                };
                self.best = Some(follow(problem, oracle, meter, seen));
                // The pair is looked at again: it keeps a lesser distance.
                ControlFlow::Continue(clock)
            }
            Step::Overlap(contact) => ControlFlow::Break(Ok(ClosestApproach::Overlapping {
                overlap: Overlap::Pieces(contact),
            })),
            Step::Stalled => {
                self.stuck = Some(Limit::Stalled);
                ControlFlow::Continue(f64::INFINITY)
            }
            Step::GaveUp => {
                self.stuck = Some(Limit::OracleGaveUp);
                ControlFlow::Continue(f64::INFINITY)
            }
        }
    }

    fn stopped(&mut self, problem: &Problem<'_>, _: f64, limit: Limit) -> Self::Found {
        Ok(self.unresolved(problem, limit))
    }

    fn done(&mut self, problem: &Problem<'_>) -> Self::Found {
        if let Some(limit) = self.stuck {
            return Ok(self.unresolved(problem, limit));
        }
        match self.proven.end(problem) {
            Outcome::Overlapping { overlap } => Ok(ClosestApproach::Overlapping { overlap }),
            Outcome::Free { proven_gap } => self.found(problem, proven_gap),
            Outcome::Unresolved { reason, .. } => Ok(self.unresolved(problem, reason)),
            Outcome::Contact { .. } | Outcome::Touching { .. } => {
                unreachable!("pairs that waited are in no contact")
            }
        }
    }
}
