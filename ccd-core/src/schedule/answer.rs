//! Runs a search as the problem's policy for the start demands.

mod given;

use super::meter::Meter;
use super::scratch::Scratch;
use super::start::at_start;
use crate::answer::{Answer, Outcome, Stats};
use crate::distance::oracle::DistanceOracle;
use crate::math::order::greater;
use crate::problem::Problem;
use crate::settings::StartPolicy;
use crate::touching_plane::TouchingPlane;
pub(super) use given::{contact_of_given, of_given};

/// Searches as the problem's policy for the start demands, in the order of time.
///
/// Bodies that begin in contact and are to be let go are searched again at half the gap that they
/// began with: pairs that part or slide keep more than that, pairs that approach do not. If there
/// is no gap worth the name, the pairs that rest on each other are let go, each on its own.
///
/// A search adds its work to the meter, which lends it the memory.
pub(crate) fn answer<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    scratch: &mut Scratch,
    search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> Answer {
    let as_found = |_: &Problem<'_>, _: &mut O, _: &mut Meter| None;
    answer_after(problem, oracle, scratch, as_found, search)
}

/// Like [`answer`] for a search in any order: it may pass over a contact at the start, for which bodies
/// that are to be let go are examined first.
pub(crate) fn answer_in_any_order<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    scratch: &mut Scratch,
    search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> Answer {
    let at_start = |problem: &Problem<'_>, oracle: &mut O, meter: &mut Meter| {
        let beyond = problem.contact_distance().next_up();
        at_start(problem, beyond, oracle, meter)
    };
    answer_after(problem, oracle, scratch, at_start, search)
}

/// Searches as the policy demands; bodies that are to be let go have a `look` taken at them first, which may
/// have the answer.
fn answer_after<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    scratch: &mut Scratch,
    look: impl FnOnce(&Problem<'_>, &mut O, &mut Meter) -> Option<Outcome>,
    mut search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> Answer {
    metered(problem, oracle, scratch, |oracle, meter| {
        let outcome = match problem.start {
            StartPolicy::Report => search(problem, oracle, meter),
            StartPolicy::Leave => {
                let problem = problem.reporting();
                let seen = look(&problem, oracle, meter);
                seen.unwrap_or_else(|| search(&problem, oracle, meter))
            }
        };
        let parting = let_go(problem, problem.start, &outcome, oracle, meter);
        let (outcome, tolerance) = match parting {
            Some(problem) => {
                let outcome = search(&problem, oracle, meter);
                (outcome, shown(&problem, &outcome))
            }
            None => (outcome, problem.tolerance),
        };
        let within = problem.margin + tolerance;
        (of_given(problem, oracle, meter, outcome, within), tolerance)
    })
    .answer()
}

/// Returns the problem of bodies that touch at the start and are to be let go; none of others.
pub(super) fn let_go<'a, O: DistanceOracle>(
    problem: &Problem<'a>,
    start: StartPolicy,
    outcome: &Outcome,
    oracle: &mut O,
    meter: &mut Meter,
) -> Option<Problem<'a>> {
    match (start, outcome) {
        (StartPolicy::Leave, Outcome::Touching { contact }) => {
            let (within, at_start) = (problem.contact_distance(), problem.time(0.0));
            // The normal is needed, and that of two pieces alone may be any.
            let contact = contact_of_given(problem, oracle, meter, *contact, within, at_start);
            let gap = contact.separation.lower - problem.margin;
            Some(problem.leaving(gap, TouchingPlane::of(problem, &contact)))
        }
        _ => None,
    }
}

/// Something that was searched for, with its tolerance and the cost.
pub(super) struct Searched<T> {
    pub(super) found: T,
    pub(super) tolerance: f64,
    pub(super) stats: Stats,
}

impl Searched<Outcome> {
    pub(super) fn answer(self) -> Answer {
        Answer {
            outcome: self.found,
            tolerance: self.tolerance,
            stats: self.stats,
        }
    }
}

/// Adds up the work on a search, which returns what it found and the tolerance.
pub(super) fn metered<O: DistanceOracle, T>(
    problem: &Problem<'_>,
    oracle: &mut O,
    scratch: &mut Scratch,
    solve: impl FnOnce(&mut O, &mut Meter) -> (T, f64),
) -> Searched<T> {
    let before = oracle.effort();
    let mut meter = Meter::new(problem);
    meter.scratch = scratch.take();
    let (found, tolerance) = solve(oracle, &mut meter);
    *scratch = meter.scratch.take();
    Searched {
        found,
        tolerance,
        stats: Stats {
            effort: oracle.effort() - before,
            ..meter.stats
        },
    }
}

/// Returns the tolerance that the outcome of bodies let go shows. Pieces that rest on each other are in
/// contact again once they cannot be proven apart, even if their distance is known less exactly than the
/// least tolerance asks.
pub(super) fn shown(problem: &Problem<'_>, outcome: &Outcome) -> f64 {
    match outcome {
        Outcome::Contact { contact, .. } => {
            let shown = (contact.separation.upper - problem.margin).next_up();
            greater(problem.tolerance, shown)
        }
        _ => problem.tolerance,
    }
}
