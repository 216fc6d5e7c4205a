//! Answers about two bodies as numbers. JavaScript reads them by the names of the fields.

use super::fields::named_numbers;
use super::limits::limit_number;
use rigid_ccd::answer::{Contact, Feature, HitKind, Overlap, Unresolved};
use rigid_ccd::{Answer, Hit, Outcome};
use wasm_bindgen::prelude::wasm_bindgen;

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

named_numbers! {
    /// An answer to a query from time 0 to a duration.
    pub(crate) struct AnswerNumbers {
        tolerance: f64,
        /// Bounds of the distance.
        lower: f64,
        upper: f64,
        /// The time before which nothing touches, and the time after which nothing touches.
        safe_until: f64,
        safe_from: f64,
        /// The number of the limit.
        limit: f64,
        /// The kinds of the first and the last contact of an interval.
        first_kind: f64,
        last_kind: f64,
        /// The first or nearest contact.
        first: ContactNumbers,
        /// The last contact of an interval.
        last: ContactNumbers,
    }
}

named_numbers! {
    /// A contact.
    pub(crate) struct ContactNumbers {
        /// 0 if there is no contact, 1 if only a point inside both bodies is known, and otherwise 2.
        known: f64,
        time: f64,
        witness_a: [f64; 3],
        witness_b: [f64; 3],
        normal: [f64; 3],
        /// Bounds of the distance.
        lower: f64,
        upper: f64,
        /// The kind of a feature, and its mesh indices.
        feature_a: [f64; 3],
        feature_b: [f64; 3],
    }
}

impl AnswerNumbers {
    /// Writes an answer to a query from time 0 to `duration`, and returns its kind.
    pub(crate) fn write(&mut self, answer: &Answer, duration: f64) -> AnswerKind {
        let outcome = &answer.outcome;
        *self = AnswerNumbers {
            tolerance: answer.tolerance,
            lower: outcome.lower(),
            upper: outcome.upper(),
            ..AnswerNumbers::default()
        };
        match *outcome {
            Outcome::Free { .. } => {
                self.safe_until = duration;
                AnswerKind::Free
            }
            Outcome::Contact { time, contact } => {
                self.first = ContactNumbers::of_contact(time, &contact);
                AnswerKind::Contact
            }
            Outcome::Touching { contact } => {
                self.first = ContactNumbers::of_contact(0.0, &contact);
                AnswerKind::Touching
            }
            Outcome::Overlapping { overlap, .. } => {
                self.first = ContactNumbers::of_overlap(0.0, &overlap);
                AnswerKind::Overlapping
            }
            Outcome::Interval { first, last } => {
                (self.first_kind, self.first) = numbers_of_hit(&first);
                (self.last_kind, self.last) = numbers_of_hit(&last);
                AnswerKind::Interval
            }
            Outcome::LeastDistance { time, contact, .. } => {
                self.first = ContactNumbers::of_contact(time, &contact);
                AnswerKind::LeastDistance
            }
            Outcome::Unresolved(known) => {
                self.write_unresolved(&known);
                AnswerKind::Unresolved
            }
        }
    }

    fn write_unresolved(&mut self, known: &Unresolved) {
        [self.safe_until, self.safe_from] = [known.safe_until, known.safe_from];
        self.limit = limit_number(known.limit) as f64;
        if let Some((time, contact)) = known.nearest_contact {
            self.first = ContactNumbers::of_contact(time, &contact);
        }
    }
}

/// Returns the kind of a contact, and the contact as numbers.
fn numbers_of_hit(hit: &Hit) -> (f64, ContactNumbers) {
    let (kind, numbers) = match &hit.kind {
        HitKind::Contact(contact) => {
            let numbers = ContactNumbers::of_contact(hit.time, contact);
            (AnswerKind::Contact, numbers)
        }
        HitKind::Touching(contact) => {
            let numbers = ContactNumbers::of_contact(hit.time, contact);
            (AnswerKind::Touching, numbers)
        }
        HitKind::Overlapping(overlap) => {
            let numbers = ContactNumbers::of_overlap(hit.time, overlap);
            (AnswerKind::Overlapping, numbers)
        }
    };
    (f64::from(kind as u8), numbers)
}

impl ContactNumbers {
    fn of_contact(time: f64, contact: &Contact) -> Self {
        let separation = &contact.separation;
        ContactNumbers {
            known: 2.0,
            time,
            witness_a: separation.witness_a.to_array(),
            witness_b: separation.witness_b.to_array(),
            normal: separation.normal.to_array(),
            lower: separation.lower,
            upper: separation.upper,
            feature_a: feature_numbers(contact.feature_a),
            feature_b: feature_numbers(contact.feature_b),
        }
    }

    fn of_overlap(time: f64, overlap: &Overlap) -> Self {
        match overlap {
            Overlap::Pieces(contact) => ContactNumbers::of_contact(time, contact),
            Overlap::AInsideB(point) | Overlap::BInsideA(point) => ContactNumbers {
                known: 1.0,
                time,
                witness_a: point.to_array(),
                witness_b: point.to_array(),
                ..ContactNumbers::default()
            },
        }
    }
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
