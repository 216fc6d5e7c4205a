//! What is found at the start: touching, overlapping, or one inside the other.

use super::pair::Step;
use crate::containment::{self, Containment};
use crate::oracle::DistanceOracle;
use crate::outcome::{Answer, Contact, Limit, Outcome, Overlap, Stats};
use crate::problem::{Problem, StartPolicy};
use std::ops::ControlFlow;

/// Searches as the problem's policy for the start demands.
///
/// Bodies that begin in contact and are to be let go are searched again at half the gap that they
/// began with: what parts or slides keeps more than that, what approaches does not. Where there is
/// no gap to speak of, it is the pairs that rest on each other that are let go, each on its own.
///
/// A search adds to the stats what it took.
pub(crate) fn answer<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    mut search: impl FnMut(&Problem<'_>, &mut O, &mut Stats) -> Outcome,
) -> Answer {
    let before = oracle.effort();
    let mut stats = Stats::default();
    let outcome = search(&problem.reporting(), oracle, &mut stats);
    let (outcome, tolerance) = match (problem.start, outcome) {
        (StartPolicy::Leave, Outcome::Touching { contact }) => {
            let problem = problem.leaving(contact.separation.lower - problem.margin);
            (search(&problem, oracle, &mut stats), problem.tolerance)
        }
        _ => (outcome, problem.tolerance),
    };
    stats.effort = oracle.effort() - before;
    Answer {
        outcome,
        tolerance,
        stats,
    }
}

/// Collects what pairs of pieces are like at the start, until the first clock past it.
#[derive(Debug, Default)]
pub(crate) struct Start {
    touching: Option<Contact>,
    /// The pairs that no axis keeps apart.
    resting: Vec<[u32; 2]>,
    over: bool,
}

impl Start {
    /// A pair touches at the start; another one may be nearer, or overlap still.
    fn touch(&mut self, contact: Contact) {
        // Written so that NaN is not apart.
        if !(contact.separation.lower > 0.0) {
            self.resting.push([contact.piece_a, contact.piece_b]);
        }
        let nearest = self.touching.get_or_insert(contact);
        if contact.separation.lower < nearest.separation.lower {
            *nearest = contact;
        }
    }

    /// What a pair of pieces at clock `s` has come to: the clock to wait for, none when it touches at
    /// the start, or the answer.
    pub(crate) fn settle(
        &mut self,
        problem: &Problem<'_>,
        step: Step,
        s: f64,
    ) -> ControlFlow<Outcome, Option<f64>> {
        let unresolved = |reason| Outcome::Unresolved {
            safe_until: problem.time(s),
            reason,
        };
        ControlFlow::Break(match step {
            Step::FreeUntil(clock) => return ControlFlow::Continue(Some(clock)),
            Step::Contact(contact) if s > 0.0 => {
                let time = problem.time(s);
                Outcome::Contact { time, contact }
            }
            Step::Contact(contact) => {
                self.touch(contact);
                return ControlFlow::Continue(None);
            }
            Step::Overlap(contact) => Start::overlapping(contact),
            Step::Stalled => unresolved(Limit::Stalled),
            Step::GaveUp => unresolved(Limit::OracleGaveUp),
            Step::Undecided => unresolved(Limit::Undecided),
        })
    }

    /// A pair overlaps.
    fn overlapping(contact: Contact) -> Outcome {
        Outcome::Overlapping {
            overlap: Overlap::Pieces(contact),
        }
    }

    /// The answer as far as it is known.
    pub(crate) fn touching(&self) -> Option<Outcome> {
        self.touching.map(|contact| Outcome::Touching { contact })
    }

    /// All pairs are past the start and none overlaps: the answer, if it lies there.
    pub(crate) fn end(&mut self, problem: &Problem<'_>) -> Option<Outcome> {
        if std::mem::replace(&mut self.over, true) {
            return None;
        }
        if problem.start == StartPolicy::Leave {
            // The search that reported the contact has looked already.
            return self.touching();
        }
        match containment::at_start(problem, &std::mem::take(&mut self.resting)) {
            Containment::Inside(overlap) => Some(Outcome::Overlapping { overlap }),
            Containment::Outside => self.touching(),
            Containment::Undecided => Some(Outcome::Unresolved {
                safe_until: 0.0,
                reason: Limit::Undecided,
            }),
        }
    }
}
