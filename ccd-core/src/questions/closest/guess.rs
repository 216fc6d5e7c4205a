//! Estimates the least distance before the search for it, from measurements at a few times.

use super::follow::follow_to_minimum;
use super::{NearestPair, unresolved_outcome};
use crate::answer::{Limit, Outcome, Unresolved};
use crate::distance::oracle::DistanceOracle;
use crate::engine::meter::Meter;
use crate::engine::nearest::{EarlyEndReason, NearestSearch};
use crate::engine::shortcuts::bounding_volumes::{clock_of_nearest_balls, least_distance};
use crate::engine::start::overlap_outcome;
use crate::math::order::greater;
use crate::problem::Problem;
use crate::tuning::{FOLLOW_TOLERANCE_SHARE, MAX_INITIAL_MEASUREMENTS};
use std::ops::ControlFlow;

/// Measures the bodies at the time at which their bounding balls are nearest, and follows the nearest pieces to a local
/// minimum of their distance. It repeats this at the time of the minimum, as long as the distance decreases.
///
/// Breaks with the answer if the bodies overlap at the start, or a limit is reached.
pub(crate) fn estimate_nearest_pair<O: DistanceOracle>(
    problem: &Problem<'_>,
    beyond: f64,
    oracle: &mut O,
    meter: &mut Meter,
) -> ControlFlow<Outcome, Option<NearestPair>> {
    let mut best: Option<NearestPair> = None;
    let mut clock = clock_of_nearest_balls(problem);
    for _ in 0..MAX_INITIAL_MEASUREMENTS {
        let upper = best.map_or(beyond, |best| best.contact.separation.upper);
        let found = search_nearest_pieces_at(problem, clock, upper, oracle, meter);
        let Some(found) = found.map_break(|stop| early_end_outcome(problem, best, stop))? else {
            break;
        };
        let followed = follow_to_minimum(problem, oracle, meter, found);
        let fell = found.contact.separation.upper - followed.contact.separation.upper;
        best = Some(followed);
        clock = followed.time;
        // Written so that NaN is no fall.
        if !(fell > FOLLOW_TOLERANCE_SHARE * problem.tolerance) {
            break;
        }
    }
    // If `beyond` is infinite, every distance is of interest, and none was found.
    if best.is_none() && beyond == f64::INFINITY {
        ControlFlow::Break(unresolved_outcome(0.0, Limit::OracleGaveUp))
    } else {
        ControlFlow::Continue(best)
    }
}

/// Returns the nearest pieces of the bodies at a time; `None` if all pieces are at least `beyond` apart.
pub(crate) fn search_nearest_pieces_at<O: DistanceOracle>(
    problem: &Problem<'_>,
    clock: f64,
    beyond: f64,
    oracle: &mut O,
    meter: &mut Meter,
) -> ControlFlow<EarlyEndReason, Option<NearestPair>> {
    let mut lists = std::mem::take(&mut meter.scratch_memory().nearest_search_buffers);
    let mut nearest = NearestSearch::new(problem, clock, &mut lists).with_cutoff(beyond);
    let stopped = nearest.search(oracle, meter);
    let found = nearest.nearest_pieces();
    lists.clear();
    meter.scratch_memory().nearest_search_buffers = lists;
    let best = |(pieces, contact)| NearestPair {
        time: clock,
        pieces,
        contact,
    };
    match stopped {
        // The bodies have met before.
        Some(EarlyEndReason::Overlap(pieces, contact)) if clock > 0.0 => {
            ControlFlow::Continue(Some(best((pieces, contact))))
        }
        Some(stop) => ControlFlow::Break(stop),
        None => ControlFlow::Continue(found.map(best)),
    }
}

/// Returns the outcome for a measurement that was stopped, because the bodies overlap at the start or a limit is
/// reached.
fn early_end_outcome(
    problem: &Problem<'_>,
    best: Option<NearestPair>,
    stop: EarlyEndReason,
) -> Outcome {
    match stop {
        EarlyEndReason::Overlap(_, contact) => overlap_outcome(contact),
        EarlyEndReason::Limit(limit) => {
            let seen = best.map(|best| best.time_and_contact(problem, 0.0));
            let lower = greater(0.0, least_distance(problem));
            Outcome::Unresolved(Unresolved::for_least_distance(lower, seen, limit))
        }
    }
}
