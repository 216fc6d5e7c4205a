//! The facts that are proven about two bodies in the course of a search.

use super::meter::Meter;
use super::pieces::contact_rule::PairStep;
use super::start::{classify_start_contact, overlap_outcome};
use crate::answer::{Contact, Limit, Outcome};
use crate::distance::containment::containment_at_start;
use crate::distance::oracle::DistanceOracle;
use crate::motion::free_time::FreeTime;
use crate::problem::Problem;
use crate::settings::StartPolicy;
use std::ops::ControlFlow;

/// The facts proven about the bodies as a whole, independent of pairs that still wait.
#[derive(Debug, Default)]
pub(crate) struct ProvenFacts {
    /// True if no pair of pieces is in contact at the start, and neither body is inside the other.
    apart_at_start: bool,
}

impl ProvenFacts {
    /// Processes the advance of a pair of pieces at clock `s`: returns for how long the pair stays apart, or the
    /// outcome of the query.
    ///
    /// A pair that touches at the start is not the answer yet: another one may be nearer, or overlap.
    pub(crate) fn free_time_or_outcome<O: DistanceOracle>(
        &self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        step: PairStep,
        s: f64,
    ) -> ControlFlow<Outcome, FreeTime> {
        let unresolved = |reason| Outcome::unresolved(problem.time_of_clock(s), reason);
        ControlFlow::Break(match step {
            PairStep::Free(free) => return ControlFlow::Continue(free),
            PairStep::Contact(contact) if s > 0.0 => self.contact_outcome(problem, contact, s),
            PairStep::Contact(contact) => classify_start_contact(problem, oracle, meter, contact),
            PairStep::Overlap(contact) => overlap_outcome(contact),
            PairStep::Stalled => unresolved(Limit::Stalled),
            PairStep::GaveUp => unresolved(Limit::OracleGaveUp),
        })
    }

    /// Returns the outcome of a query that ends with a pair in contact at clock `s`. Other pairs may be nearer: only
    /// their clocks bound their distances.
    pub(crate) fn contact_outcome(
        &self,
        problem: &Problem<'_>,
        contact: Contact,
        s: f64,
    ) -> Outcome {
        Outcome::Contact {
            time: problem.time_of_clock(s),
            contact: contact.cap_lower_bound(problem.proven_gap()),
        }
    }

    /// Records that no pair is in contact at the start; returns the outcome if one body is inside the other.
    #[inline]
    pub(crate) fn check_containment_once_apart(
        &mut self,
        problem: &Problem<'_>,
    ) -> Option<Outcome> {
        if self.apart_at_start {
            return None;
        }
        self.check_containment_at_start(problem)
    }

    // Out of the search's loop, which would otherwise copy an outcome at every visit.
    #[cold]
    fn check_containment_at_start(&mut self, problem: &Problem<'_>) -> Option<Outcome> {
        self.apart_at_start = true;
        // Bodies that are let go were examined when their contact was found.
        match problem.start_policy {
            StartPolicy::Leave => None,
            StartPolicy::Report => containment_at_start(problem, &[], &mut Vec::new()),
        }
    }

    /// Returns the outcome of a query whose pairs are all apart to the end.
    pub(crate) fn final_outcome(&mut self, problem: &Problem<'_>) -> Outcome {
        self.check_containment_once_apart(problem)
            .unwrap_or(Outcome::Free {
                proven_gap: problem.proven_gap(),
            })
    }
}
