//! Translates answers about the triangulated surfaces of convex bodies to the bodies that the caller gave.

mod common_normal;

use crate::answer::{Contact, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::distance::separation::support_gap;
use crate::engine::meter::Meter;
use crate::engine::pieces::placed_pair::PlacedPair;
use crate::math::order::{greater, lesser};
use crate::math::vector::{distance, unit};
use crate::problem::Problem;
use crate::rounding::{MIN_APPROACH_PER_ROUNDING, is_direction_uncertain};
use crate::settings::ContactNormals;
use common_normal::common_normal;

/// Translates the contacts of an outcome from triangulated surfaces to the bodies that the caller gave. The normal, the
/// nearest points and the bounds of a contact are those of the pieces that it names.
///
/// Here `within` returns the distance at which a contact was to be found.
pub(crate) fn outcome_on_original_bodies<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    outcome: Outcome,
    within: impl Fn(&Contact) -> f64,
) -> Outcome {
    outcome.map_contacts(|contact, time| {
        let within = within(&contact);
        convert_contact_to_given_bodies(problem, oracle, meter, contact, within, time)
    })
}

/// Converts a contact at `time`, found on triangles, to one of the bodies that the caller gave; see
/// [`outcome_on_original_bodies`].
pub(crate) fn convert_contact_to_given_bodies<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    contact: Contact,
    within: f64,
    time: f64,
) -> Contact {
    let s = problem.clock_of_time(time);
    match problem.with_given_bodies() {
        Some(given) => {
            let contact = remeasure_contact(&given, oracle, meter, contact, within, s);
            replace_uncertain_normal(&given, meter, contact, s)
        }
        None => replace_uncertain_normal(problem, meter, contact, s),
    }
}

/// Replaces a contact's normal by a common normal of both surfaces if the normal is mostly rounding error. A normal of
/// two touching pieces need not be a normal of the surfaces around them.
fn replace_uncertain_normal(
    problem: &Problem<'_>,
    meter: &mut Meter,
    contact: Contact,
    s: f64,
) -> Contact {
    let mut seen = contact.separation;
    let witnesses = [seen.witness_a, seen.witness_b];
    if problem.contact_normals == ContactNormals::OfPieces {
        return contact;
    }
    if !is_direction_uncertain(distance(witnesses[0], witnesses[1]), problem.rounding) {
        return contact;
    }
    let placed = PlacedPair::new(problem, [contact.piece_a, contact.piece_b], s);
    let pieces = &placed.pieces;
    // Rounded pieces are skipped: their cores are apart.
    if pieces.a.radius + pieces.b.radius > 0.0 {
        return contact;
    }
    let [frame, _] = &placed.frames;
    let points = witnesses.map(|at| frame.inverse_transform_point(problem.to_problem_point(at)));
    let towards = frame.inverse_transform_vector(seen.normal);
    let Some(axis) = common_normal(&placed, points, towards, meter) else {
        return contact;
    };
    let gap = support_gap(pieces, axis, points[0]) - problem.rounding;
    // Overlapping pieces have no direction between them. Either direction may prove that they touch: an oracle that
    // computes their nearest points up to rounding need not return a direction. Written so that NaN counts as an
    // overlap.
    if !(greater(seen.lower, gap) >= -MIN_APPROACH_PER_ROUNDING * problem.rounding) {
        return contact;
    }
    seen.lower = lesser(seen.lower, gap);
    seen.normal = unit(frame.rotation * axis).unwrap_or(seen.normal);
    Contact {
        separation: seen,
        ..contact
    }
}

fn remeasure_contact<O: DistanceOracle>(
    given: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    contact: Contact,
    within: f64,
    s: f64,
) -> Contact {
    let ids = [contact.piece_a, contact.piece_b];
    let placed = PlacedPair::new(given, ids, s);
    let bound = contact.separation.lower;
    let checked = placed.query_oracle(oracle, &mut O::Cache::default(), meter);
    match checked.filter(|checked| checked.upper <= within) {
        Some(checked) => placed.contact(ids, &checked).cap_lower_bound(bound),
        // The oracle finds less for the pieces than for their surfaces. The result for the surfaces remains, with the
        // bounds that its normal proves for the pieces.
        None => {
            let axis = placed.frames[0].inverse_transform_vector(contact.separation.normal);
            let from = placed.frames[0]
                .inverse_transform_point(given.to_problem_point(contact.separation.witness_a));
            let radii = placed.pieces.a.radius + placed.pieces.b.radius;
            contact
                .cap_lower_bound(support_gap(&placed.pieces, axis, from) - radii - given.rounding)
        }
    }
}
