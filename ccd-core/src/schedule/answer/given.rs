//! Translates answers about surfaces to the pieces that have these surfaces.

use crate::distance::oracle::DistanceOracle;
use crate::distance::separation::support_gap;
use crate::outcome::{Contact, Outcome, Overlap};
use crate::problem::Problem;
use crate::schedule::meter::Meter;
use crate::schedule::pieces::pair;
use crate::schedule::pieces::snapshot::Snapshot;

/// Returns the outcome for the given bodies. The normal, the witnesses and the bounds of a contact
/// are those of the pieces that it names.
///
/// Here `within` is the distance at which a contact was to be found.
pub(in crate::schedule) fn of_given<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    outcome: Outcome,
    within: f64,
) -> Outcome {
    let mut told = |contact, time| contact_of_given(problem, oracle, meter, contact, within, time);
    match outcome {
        Outcome::Contact { time, contact } => Outcome::Contact {
            time,
            contact: told(contact, time),
        },
        Outcome::Touching { contact } => Outcome::Touching {
            contact: told(contact, 0.0),
        },
        Outcome::Overlapping {
            overlap: Overlap::Pieces(contact),
        } => Outcome::Overlapping {
            overlap: Overlap::Pieces(told(contact, 0.0)),
        },
        Outcome::Overlapping { .. } | Outcome::Free { .. } | Outcome::Unresolved { .. } => outcome,
    }
}

/// Like [`of_given`] for the contact at a time.
pub(in crate::schedule) fn contact_of_given<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    contact: Contact,
    within: f64,
    time: f64,
) -> Contact {
    match problem.given() {
        Some(given) => of_pieces(&given, oracle, meter, contact, within, given.clock(time)),
        None => contact,
    }
}

fn of_pieces<O: DistanceOracle>(
    given: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    contact: Contact,
    within: f64,
    s: f64,
) -> Contact {
    let ids = [contact.piece_a, contact.piece_b];
    let snapshot = Snapshot::new(given, ids[0], ids[1], s);
    let bound = contact.separation.lower;
    let checked = snapshot.ask(oracle, &mut O::Cache::default(), meter);
    match checked.filter(|checked| checked.upper <= within) {
        Some(checked) => pair::contact(&snapshot, ids, &checked).no_nearer_than(bound),
        // The oracle finds less for the pieces: the result on their surfaces remains, with the
        // bounds that its normal proves for them.
        None => {
            let axis = snapshot.frames[0].inverse_vector(contact.separation.normal);
            let from = snapshot.frames[0].inverse_point(given.local(contact.separation.witness_a));
            let radii = snapshot.pieces.a.radius + snapshot.pieces.b.radius;
            contact
                .no_nearer_than(support_gap(&snapshot.pieces, axis, from) - radii - given.rounding)
        }
    }
}
