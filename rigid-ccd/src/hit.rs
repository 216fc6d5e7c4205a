//! The first contact of two bodies.

use ccd_core::glam::DVec3;
use ccd_core::{Answer, Contact, Outcome, Overlap};

use crate::Error;

/// The first contact of two bodies.
///
/// ```
/// use rigid_ccd::{Body, HitKind, Motion, Overlap, first_contact};
/// let (a, b) = (Body::ball(0.1)?, Body::cuboid([1.0, 1.0, 1.0])?);
/// let hit = first_contact((&a, Motion::STILL), (&b, Motion::STILL), 1.0)?;
/// match hit.expect("they are in contact").kind {
///     HitKind::Contact => println!("they come into contact"),
///     HitKind::Touching => println!("they touch at the start"),
///     HitKind::Overlapping(Overlap::AInsideB(_)) => println!("A is inside B at the start"),
///     HitKind::Overlapping(Overlap::BInsideA(_)) => println!("B is inside A at the start"),
///     HitKind::Overlapping(Overlap::Pieces(_)) => println!("pieces intersect at the start"),
/// }
/// # Ok::<(), rigid_ccd::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The time of the contact, in the motions' unit of time; no contact happens before it.
    /// [`StartPolicy::Leave`](ccd_core::StartPolicy::Leave) may ignore contacts at the start.
    pub time: f64,
    /// The kind of contact.
    pub kind: HitKind,
    /// The point of body A nearest to B, in world coordinates at that time.
    pub witness_a: DVec3,
    /// The point of body B nearest to A, in world coordinates at that time.
    pub witness_b: DVec3,
    /// The normal, the distance and the features in contact. None where one body is inside the other at
    /// the start and no two pieces intersect: both witnesses are then one point that lies in both bodies.
    pub contact: Option<Contact>,
}

/// The kind of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HitKind {
    /// The bodies come within margin + tolerance.
    Contact,
    /// The bodies are within margin + tolerance at the start, without overlapping.
    Touching,
    /// The bodies intersect at the start, or one is inside the other. A body inside a convex piece, such as
    /// a box, counts as [`Overlap::Pieces`].
    Overlapping(Overlap),
}

impl Hit {
    /// Returns the hit of an answer; none when the bodies stay apart.
    pub(crate) fn from_answer(answer: &Answer) -> Result<Option<Hit>, Error> {
        match answer.outcome {
            Outcome::Unresolved { safe_until, reason } => {
                Err(Error::Unresolved { safe_until, reason })
            }
            _ => Ok(Hit::from_outcome(&answer.outcome)),
        }
    }

    /// Returns the hit of an outcome; none when the bodies stay apart, or that is not known.
    pub(crate) fn from_outcome(outcome: &Outcome) -> Option<Hit> {
        let at = |time, kind, contact: Contact| Hit {
            time,
            kind,
            witness_a: contact.separation.witness_a,
            witness_b: contact.separation.witness_b,
            contact: Some(contact),
        };
        match *outcome {
            Outcome::Free { .. } | Outcome::Unresolved { .. } => None,
            Outcome::Contact { time, contact } => Some(at(time, HitKind::Contact, contact)),
            Outcome::Touching { contact } => Some(at(0.0, HitKind::Touching, contact)),
            Outcome::Overlapping { overlap } => {
                let kind = HitKind::Overlapping(overlap);
                Some(match overlap {
                    Overlap::Pieces(contact) => at(0.0, kind, contact),
                    Overlap::AInsideB(point) | Overlap::BInsideA(point) => Hit {
                        time: 0.0,
                        kind,
                        witness_a: point,
                        witness_b: point,
                        contact: None,
                    },
                })
            }
        }
    }
}
