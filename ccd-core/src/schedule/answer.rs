//! A search run as the problem's policy for the start demands.

mod given;

use super::meter::Meter;
use crate::distance::oracle::DistanceOracle;
use crate::outcome::{Answer, Outcome, Stats};
use crate::problem::{Problem, StartPolicy};
use given::of_given;

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
