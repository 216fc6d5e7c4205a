//! The time and the kind of a contact in an answer.

use super::{Contact, Overlap};
use glam::DVec3;

/// A time at which the bodies are in contact, with the kind of the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The time of the contact, in the motions' unit. Nothing touches before a first contact, except for contacts at
    /// the start that [`StartPolicy::Leave`](crate::StartPolicy::Leave) ignores.
    pub time: f64,
    /// The kind of the contact: near, touching at the start, or overlapping.
    pub kind: HitKind,
}

/// The kind of a contact, with the pieces in contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HitKind {
    /// The bodies come within margin + tolerance of each other.
    Contact(Contact),
    /// The bodies are within margin + tolerance at the start, without overlapping.
    Touching(Contact),
    /// The bodies overlap at the start, or in a last contact at the end. A body inside a convex piece, such as a box,
    /// counts as [`Overlap::Pieces`].
    Overlapping(Overlap),
}

impl Hit {
    /// Returns the pieces in contact, with the normal, the distance and the features; `None` if one body is inside the
    /// other without two pieces that intersect.
    pub fn contact(&self) -> Option<Contact> {
        match self.kind {
            HitKind::Contact(contact) | HitKind::Touching(contact) => Some(contact),
            HitKind::Overlapping(overlap) => overlap.contact(),
        }
    }

    /// Returns the point of A that is nearest to B at the time of the contact, in world coordinates.
    pub fn witness_a(&self) -> DVec3 {
        self.witnesses()[0]
    }

    /// Returns the point of B that is nearest to A at the time of the contact, in world coordinates.
    pub fn witness_b(&self) -> DVec3 {
        self.witnesses()[1]
    }

    /// Returns the nearest points of A and B. If one body is inside the other, both are the same point.
    fn witnesses(&self) -> [DVec3; 2] {
        match self.kind {
            HitKind::Contact(contact)
            | HitKind::Touching(contact)
            | HitKind::Overlapping(Overlap::Pieces(contact)) => {
                let separation = contact.separation;
                [separation.witness_a, separation.witness_b]
            }
            HitKind::Overlapping(Overlap::AInsideB(point) | Overlap::BInsideA(point)) => [point; 2],
        }
    }
}
