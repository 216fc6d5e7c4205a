//! A first contact, or what is in contact at the start.

use ccd_core::glam::DVec3;
use ccd_core::{Answer, Contact, Outcome, Overlap};

use crate::Error;

/// The first contact of two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// When, in the motions' unit of time: nothing touches before, but for what
    /// [`StartPolicy::Leave`](ccd_core::StartPolicy::Leave) lets go of at the start.
    pub time: f64,
    /// Whether the bodies come into contact, or are in contact at the start.
    pub kind: HitKind,
    /// A point of body A where it is nearest to B, in world coordinates at that time.
    pub witness_a: DVec3,
    /// A point of body B where it is nearest to A.
    pub witness_b: DVec3,
    /// The normal, the distance and the features; none where one body lies inside the other at the
    /// start: both witnesses are then the same point, which lies in both.
    pub contact: Option<Contact>,
}

/// How a contact comes about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HitKind {
    /// The bodies come within margin + tolerance.
    Contact,
    /// They are within margin + tolerance at the start, without overlapping.
    Touching,
    /// They overlap at the start, or one lies inside the other.
    Overlapping,
}

impl Hit {
    /// What an answer says in short; none when the bodies stay apart.
    pub(crate) fn of(answer: &Answer) -> Result<Option<Hit>, Error> {
        let at = |time, kind, contact: Contact| Hit {
            time,
            kind,
            witness_a: contact.separation.witness_a,
            witness_b: contact.separation.witness_b,
            contact: Some(contact),
        };
        Ok(Some(match answer.outcome {
            Outcome::Free { .. } => return Ok(None),
            Outcome::Contact { time, contact } => at(time, HitKind::Contact, contact),
            Outcome::Touching { contact } => at(0.0, HitKind::Touching, contact),
            Outcome::Overlapping { overlap } => match overlap {
                Overlap::Pieces(contact) => at(0.0, HitKind::Overlapping, contact),
                Overlap::AInsideB(point) | Overlap::BInsideA(point) => Hit {
                    time: 0.0,
                    kind: HitKind::Overlapping,
                    witness_a: point,
                    witness_b: point,
                    contact: None,
                },
            },
            Outcome::Unresolved { safe_until, reason } => {
                return Err(Error::Unresolved { safe_until, reason });
            }
        }))
    }
}
