//! Handles bodies in contact at the start: measures their distance, or proves that they overlap.

use super::meter::Meter;
use super::nearest::{EarlyEndReason, NearestSearch};
use crate::answer::{Contact, Limit, Outcome, Overlap};
use crate::distance::containment::containment_at_start;
use crate::distance::oracle::DistanceOracle;
use crate::problem::Problem;

/// Returns the outcome for bodies with two pieces in contact at the start: touching, with the bodies' distance, or
/// overlapping.
///
/// # Guarantee
/// Touching bodies are at least the contact's lower bound apart, and its pieces prove the upper one. If the oracle is
/// honest, the answer does not depend on which pieces were `seen`.
///
/// # Complexity
/// One distance of the bodies, for any margin, and one visit for every pair of pieces that may intersect.
pub(crate) fn classify_start_contact<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    seen: Contact,
) -> Outcome {
    let contact = |nearest: &NearestSearch<'_>| Some(nearest.contact(seen));
    let outcome = outcome_at_start(problem, f64::INFINITY, oracle, meter, contact);
    outcome.unwrap_or(Outcome::Touching { contact: seen })
}

/// Returns the outcome for bodies that overlap at the start or are nearer than `beyond`; `None` for bodies farther
/// apart. Bodies nearer than `beyond` count as touching, and a body inside the other counts as overlapping. If this is
/// undecided, the outcome is unresolved.
pub(crate) fn search_contact_at_start<O: DistanceOracle>(
    problem: &Problem<'_>,
    beyond: f64,
    oracle: &mut O,
    meter: &mut Meter,
) -> Option<Outcome> {
    outcome_at_start(problem, beyond, oracle, meter, |nearest| {
        nearest.nearest_contact()
    })
}

/// Searches for the nearest pieces at the start, and returns the outcome if the bodies overlap, if a limit ends the
/// search, or if the function `contact` finds a contact in its result.
/// Pieces at least as far apart as `beyond` are not measured.
fn outcome_at_start<O: DistanceOracle>(
    problem: &Problem<'_>,
    beyond: f64,
    oracle: &mut O,
    meter: &mut Meter,
    contact: impl FnOnce(&NearestSearch<'_>) -> Option<Contact>,
) -> Option<Outcome> {
    let mut lists = std::mem::take(&mut meter.scratch_memory().nearest_search_buffers);
    let mut nearest = NearestSearch::new(problem, 0.0, &mut lists).with_cutoff(beyond);
    let outcome = match nearest.search(oracle, meter) {
        Some(EarlyEndReason::Overlap(_, contact)) => Some(overlap_outcome(contact)),
        Some(EarlyEndReason::Limit(limit)) => Some(Outcome::unresolved(0.0, limit)),
        None if nearest.is_intersection_undecided => {
            Some(Outcome::unresolved(0.0, Limit::OverlapUndecided))
        }
        None => {
            let touching = contact(&nearest).map(|contact| Outcome::Touching { contact });
            let (pairs, scratch) = (&lists.unseparated_pairs, &mut lists.containment_scratch);
            containment_at_start(problem, pairs, scratch).or(touching)
        }
    };
    lists.clear();
    meter.scratch_memory().nearest_search_buffers = lists;
    outcome
}

/// Returns the outcome for two pieces that overlap.
pub(crate) fn overlap_outcome(contact: Contact) -> Outcome {
    Outcome::from_overlap(Overlap::Pieces(contact))
}

#[cfg(test)]
mod tests;
