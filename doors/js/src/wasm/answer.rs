//! Answers about two bodies as an array of numbers. `doors/js/module/answer.js` reads them by index.

use super::limits::limit_number;
use rigid_ccd::answer::{Contact, Feature, HitKind, Overlap, Unresolved};
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Answer, Hit, Outcome};
use wasm_bindgen::prelude::wasm_bindgen;

/// The length of an answer: seven numbers, then two contacts.
pub(crate) const ANSWER_LENGTH: usize = 7 + 2 * CONTACT_LENGTH;
const CONTACT_LENGTH: usize = 21;

/// The kind of an answer, or of the first or last contact of an interval.
#[wasm_bindgen]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnswerKind {
    /// The bodies stay apart.
    Free,
    /// The bodies come into contact.
    Contact,
    /// The bodies touch at the start.
    Touching,
    /// The bodies overlap at the start.
    Overlapping,
    /// The first and the last contact.
    Interval,
    /// Bounds of the least distance.
    LeastDistance,
    /// A limit was reached.
    Unresolved,
}

/// Writes an answer to a query from time 0 to `duration` as numbers, and returns its kind.
///
/// The first seven numbers are: the tolerance, the lower and the upper bound of the distance, the time before which
/// nothing touches, the time after which nothing touches, the number of the limit or the kind of the first contact of
/// an interval, and the kind of its last contact. Then follow the first or nearest contact, and the last contact. The
/// first number of a contact is 0 if there is none, 1 if only a point inside both bodies is known, and otherwise 2.
pub(crate) fn write(answer: &Answer, duration: f64, numbers: &mut [f64]) -> AnswerKind {
    numbers[..ANSWER_LENGTH].fill(0.0);
    let (values, contacts) = numbers.split_at_mut(7);
    let (nearest, last) = contacts.split_at_mut(CONTACT_LENGTH);
    let outcome = &answer.outcome;
    [values[0], values[1], values[2]] = [answer.tolerance, outcome.lower(), outcome.upper()];
    match *outcome {
        Outcome::Free { .. } => {
            values[3] = duration;
            AnswerKind::Free
        }
        Outcome::Contact { time, contact } => {
            write_contact(time, &contact, nearest);
            AnswerKind::Contact
        }
        Outcome::Touching { contact } => {
            write_contact(0.0, &contact, nearest);
            AnswerKind::Touching
        }
        Outcome::Overlapping { overlap, .. } => {
            write_overlap(0.0, &overlap, nearest);
            AnswerKind::Overlapping
        }
        Outcome::Interval { first, last: until } => {
            values[5] = write_hit(&first, nearest) as u8 as f64;
            values[6] = write_hit(&until, last) as u8 as f64;
            AnswerKind::Interval
        }
        Outcome::LeastDistance { time, contact, .. } => {
            write_contact(time, &contact, nearest);
            AnswerKind::LeastDistance
        }
        Outcome::Unresolved(known) => {
            write_unresolved(&known, values, nearest);
            AnswerKind::Unresolved
        }
    }
}

fn write_unresolved(known: &Unresolved, values: &mut [f64], nearest: &mut [f64]) {
    [values[3], values[4]] = [known.safe_until, known.safe_from];
    values[5] = limit_number(known.limit) as f64;
    if let Some((time, contact)) = known.nearest_contact {
        write_contact(time, &contact, nearest);
    }
}

fn write_hit(hit: &Hit, numbers: &mut [f64]) -> AnswerKind {
    match &hit.kind {
        HitKind::Contact(contact) => {
            write_contact(hit.time, contact, numbers);
            AnswerKind::Contact
        }
        HitKind::Touching(contact) => {
            write_contact(hit.time, contact, numbers);
            AnswerKind::Touching
        }
        HitKind::Overlapping(overlap) => {
            write_overlap(hit.time, overlap, numbers);
            AnswerKind::Overlapping
        }
    }
}

fn write_overlap(time: f64, overlap: &Overlap, numbers: &mut [f64]) {
    match overlap {
        Overlap::Pieces(contact) => write_contact(time, contact, numbers),
        Overlap::AInsideB(point) | Overlap::BInsideA(point) => {
            [numbers[0], numbers[1]] = [1.0, time];
            write_vector(*point, &mut numbers[2..]);
            write_vector(*point, &mut numbers[5..]);
        }
    }
}

fn write_contact(time: f64, contact: &Contact, numbers: &mut [f64]) {
    let separation = &contact.separation;
    [numbers[0], numbers[1]] = [2.0, time];
    write_vector(separation.witness_a, &mut numbers[2..]);
    write_vector(separation.witness_b, &mut numbers[5..]);
    write_vector(separation.normal, &mut numbers[8..]);
    [numbers[11], numbers[12]] = [separation.lower, separation.upper];
    numbers[13..16].copy_from_slice(&feature_numbers(contact.feature_a));
    numbers[16..19].copy_from_slice(&feature_numbers(contact.feature_b));
    [numbers[19], numbers[20]] = [contact.piece_a, contact.piece_b].map(f64::from);
}

fn write_vector(vector: DVec3, numbers: &mut [f64]) {
    numbers[..3].copy_from_slice(&vector.to_array());
}

/// Returns the index of the feature's kind, in the order of [`Feature`], and its mesh indices.
fn feature_numbers(feature: Feature) -> [f64; 3] {
    let [kind, one, other] = match feature {
        Feature::Vertex(vertex) => [0, vertex, 0],
        Feature::Edge(one, other) => [1, one, other],
        Feature::Face(face) => [2, face, 0],
        Feature::Piece(piece) => [3, piece, 0],
    };
    [kind, one, other].map(f64::from)
}
