//! What is found at the start: touching, overlapping, or one inside the other.

use super::given::of_given;
use super::meter::Meter;
use super::nearest;
use super::pair::Step;
use crate::containment::{self, Containment};
use crate::oracle::DistanceOracle;
use crate::order::lesser;
use crate::outcome::{Answer, Contact, Limit, Outcome, Overlap, Stats};
use crate::problem::{Problem, StartPolicy};
use std::ops::ControlFlow;

/// Searches as the problem's policy for the start demands.
///
/// Bodies that begin in contact and are to be let go are searched again at half the gap that they
/// began with: what parts or slides keeps more than that, what approaches does not. Where there is
/// no gap to speak of, it is the pairs that rest on each other that are let go, each on its own.
///
/// A search adds to the meter what it took.
pub(crate) fn answer<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    mut search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> Answer {
    let before = oracle.effort();
    let mut meter = Meter::new(problem);
    let outcome = match problem.start {
        StartPolicy::Report => search(problem, oracle, &mut meter),
        StartPolicy::Leave => search(&problem.reporting(), oracle, &mut meter),
    };
    let (outcome, tolerance) = match (problem.start, outcome) {
        (StartPolicy::Leave, Outcome::Touching { contact }) => {
            let problem = problem.leaving(contact.separation.lower - problem.margin);
            (search(&problem, oracle, &mut meter), problem.tolerance)
        }
        _ => (outcome, problem.tolerance),
    };
    let within = problem.margin + tolerance;
    Answer {
        outcome: of_given(problem, oracle, &mut meter, outcome, within),
        tolerance,
        stats: Stats {
            effort: oracle.effort() - before,
            ..meter.stats
        },
    }
}

/// What is proven of the bodies, whatever becomes of pairs that still wait.
#[derive(Debug)]
pub(crate) struct Proven {
    /// At the start no pair of pieces is in contact, and no body inside the other.
    apart_at_start: bool,
    /// The least gap that pairs of nodes were proven to keep.
    kept: f64,
}

impl Default for Proven {
    fn default() -> Self {
        Proven {
            apart_at_start: false,
            kept: f64::INFINITY,
        }
    }
}

impl Proven {
    /// Pairs of nodes keep a gap until their clocks.
    pub(crate) fn keep(&mut self, gap: f64) {
        self.kept = lesser(self.kept, gap);
    }

    /// What a pair of pieces at clock `s` has come to: the clock to wait for, or the answer.
    ///
    /// A pair that touches at the start is not the answer yet: another one may be nearer, or overlap.
    pub(crate) fn settle<O: DistanceOracle>(
        &self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        step: Step,
        s: f64,
    ) -> ControlFlow<Outcome, f64> {
        let unresolved = |reason| Outcome::Unresolved {
            safe_until: problem.time(s),
            reason,
        };
        ControlFlow::Break(match step {
            Step::FreeUntil(clock) => return ControlFlow::Continue(clock),
            Step::Contact(contact) if s > 0.0 => self.contact(problem, contact, s),
            Step::Contact(contact) => nearest::touching(problem, oracle, meter, contact),
            Step::Overlap(contact) => overlapping(contact),
            Step::Stalled => unresolved(Limit::Stalled),
            Step::GaveUp => unresolved(Limit::OracleGaveUp),
        })
    }

    /// A pair is in contact at clock `s`. Others may be nearer: they are known to keep what clocks
    /// prove, and no more.
    pub(crate) fn contact(&self, problem: &Problem<'_>, contact: Contact, s: f64) -> Outcome {
        Outcome::Contact {
            time: problem.time(s),
            contact: contact.no_nearer_than(problem.clearance(self.kept)),
        }
    }

    /// All pairs are past the start, and none was in contact there: the answer, if one body is inside
    /// the other.
    pub(crate) fn past_start(&mut self, problem: &Problem<'_>) -> Option<Outcome> {
        if std::mem::replace(&mut self.apart_at_start, true) {
            return None;
        }
        // Bodies that are let go were looked at when their contact was found.
        match problem.start {
            StartPolicy::Leave => None,
            StartPolicy::Report => contained(problem, &[]),
        }
    }

    /// All pairs are apart to the end.
    pub(crate) fn end(&mut self, problem: &Problem<'_>) -> Outcome {
        self.past_start(problem).unwrap_or(Outcome::Free {
            clearance: problem.clearance(self.kept),
        })
    }
}

/// The answer, if one body is inside the other or that cannot be told. No two pieces intersect;
/// `touching` are those that no axis keeps apart.
pub(super) fn contained(problem: &Problem<'_>, touching: &[[u32; 2]]) -> Option<Outcome> {
    match containment::at_start(problem, touching) {
        Containment::Inside(overlap) => Some(Outcome::Overlapping { overlap }),
        Containment::Outside => None,
        Containment::Undecided => Some(Outcome::Unresolved {
            safe_until: 0.0,
            reason: Limit::Undecided,
        }),
    }
}

/// Two pieces overlap.
pub(super) fn overlapping(contact: Contact) -> Outcome {
    Outcome::Overlapping {
        overlap: Overlap::Pieces(contact),
    }
}
