//! The least distance at a few times, to begin with.

use super::{Best, ClosestApproach, follow};
use crate::distance::oracle::DistanceOracle;
use crate::outcome::{Contact, Limit, Overlap};
use crate::problem::Problem;
use crate::schedule::meter::Meter;
use crate::schedule::nearest::{Nearest, Stop};
use crate::schedule::out_of_reach::nearest_clock;
use crate::tolerance::{FOLLOWED, GUESSES};
use std::ops::ControlFlow;

/// Measures the bodies when balls around them are nearest, and follows the nearest pieces from there; then
/// again at that time, for as long as it finds nearer ones.
///
/// Breaks with the answer if the bodies overlap at the start, or a limit is reached.
pub(super) fn guess<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
) -> ControlFlow<ClosestApproach, Best> {
    let mut best = None;
    let mut clock = nearest_clock(problem);
    for _ in 0..GUESSES {
        let Some(found) = nearest_at(problem, oracle, meter, clock, best)? else {
            break;
        };
        let followed = follow(problem, oracle, meter, found);
        let fell = found.contact.separation.upper - followed.contact.separation.upper;
        best = Some(followed);
        clock = followed.clock;
        // Written so that NaN is no fall.
        if !(fell > FOLLOWED * problem.tolerance) {
            break;
        }
    }
    match best {
        Some(best) => ControlFlow::Continue(best),
        None => ControlFlow::Break(unresolved(None, Limit::OracleGaveUp)),
    }
}

/// Returns the nearest pieces at a clock, if they are nearer than the best so far.
fn nearest_at<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    clock: f64,
    best: Option<Best>,
) -> ControlFlow<ClosestApproach, Option<Best>> {
    let mut lists = std::mem::take(&mut meter.memory().nearest);
    let beyond = best.map_or(f64::INFINITY, |best| best.contact.separation.upper);
    let mut nearest = Nearest::new(problem, clock, &mut lists).nearer_than(beyond);
    let stopped = nearest.search(oracle, meter);
    let found = nearest.nearest();
    lists.clear();
    meter.memory().nearest = lists;
    let contact = match stopped {
        Some(Stop::Limit(limit)) => {
            let seen = best.map(|best| (problem.time(best.clock), best.contact));
            return ControlFlow::Break(unresolved(seen, limit));
        }
        Some(Stop::Overlap(contact)) if clock == 0.0 => {
            return ControlFlow::Break(ClosestApproach::Overlapping {
                overlap: Overlap::Pieces(contact),
            });
        }
        // They meet before.
        Some(Stop::Overlap(contact)) => Some(contact),
        None => found,
    };
    ControlFlow::Continue(contact.map(|contact| Best { clock, contact }))
}

fn unresolved(nearest: Option<(f64, Contact)>, reason: Limit) -> ClosestApproach {
    ClosestApproach::Unresolved { nearest, reason }
}
