//! Runs a search as the problem's policy for the start demands.

mod given;

use super::memory::Kept;
use super::meter::Meter;
use crate::config::StartPolicy;
use crate::distance::oracle::DistanceOracle;
use crate::math::order::greater;
use crate::outcome::{Answer, Outcome, Stats};
use crate::problem::Problem;
use given::of_given;

/// Searches as the problem's policy for the start demands.
///
/// Bodies that begin in contact and are to be let go are searched again at half the gap that they
/// began with: pairs that part or slide keep more than that, pairs that approach do not. If there
/// is no gap worth the name, the pairs that rest on each other are let go, each on its own.
///
/// A search adds its work to the meter, which lends it the memory.
pub(crate) fn answer<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    kept: &mut Kept,
    mut search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> Answer {
    let before = oracle.effort();
    let mut meter = Meter::new(problem);
    meter.kept = kept.take();
    let outcome = match problem.start {
        StartPolicy::Report => search(problem, oracle, &mut meter),
        StartPolicy::Leave => search(&problem.reporting(), oracle, &mut meter),
    };
    let (outcome, tolerance) = match (problem.start, outcome) {
        (StartPolicy::Leave, Outcome::Touching { contact }) => {
            let problem = problem.leaving(contact.separation.lower - problem.margin);
            let outcome = search(&problem, oracle, &mut meter);
            (outcome, shown(&problem, &outcome))
        }
        _ => (outcome, problem.tolerance),
    };
    let within = problem.margin + tolerance;
    let outcome = of_given(problem, oracle, &mut meter, outcome, within);
    *kept = meter.kept.take();
    Answer {
        outcome,
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
fn shown(problem: &Problem<'_>, outcome: &Outcome) -> f64 {
    match outcome {
        Outcome::Contact { contact, .. } => {
            let shown = (contact.separation.upper - problem.margin).next_up();
            greater(problem.tolerance, shown)
        }
        _ => problem.tolerance,
    }
}
