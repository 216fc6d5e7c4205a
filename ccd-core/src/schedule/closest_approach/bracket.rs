//! The answer: bounds of the least distance.

use crate::body::excess::Excess;
use crate::math::order::greater;
use crate::outcome::{Answer, Contact, Limit, Overlap};

/// The answer to "how close do they come, and when?".
///
/// # Guarantee
/// The bodies are never nearer than [`lower`](ClosestApproach::lower), in floating point as well; at
/// [`time`](ClosestApproach::time) they are at most [`upper`](ClosestApproach::upper) apart.
///
/// Where bodies [exceed](crate::Body::with_excess) their shapes, that holds for the shapes. All upper bounds, those of
/// contacts too, are the distance of the witnesses and the excess of both bodies, rounded up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClosestApproach {
    /// The bodies are nearest at about `time`: then they are at most the contact's upper bound apart,
    /// and at no time nearer than `lower`.
    Nearest {
        /// A lower bound of the distance at all times, within the tolerance of the contact's upper
        /// bound.
        lower: f64,
        /// The time, in the motions' unit.
        time: f64,
        /// The nearest pieces at that time.
        contact: Contact,
    },
    /// The bodies keep the [required](crate::Config::clearance) distance at all times. Nothing more was
    /// asked: no distance is measured.
    Farther {
        /// A lower bound of the distance at all times, at least the required one.
        lower: f64,
    },
    /// The bodies are nearer than the [required](crate::Config::clearance) distance at `time`: then
    /// they are at most the contact's upper bound apart. At other times they may be nearer.
    Nearer {
        /// The time, in the motions' unit.
        time: f64,
        /// Two pieces that are nearer at that time.
        contact: Contact,
    },
    /// The bodies overlap at the start. Their shapes do, too, unless the bodies
    /// [exceed](crate::Body::with_excess) them.
    Overlapping {
        /// The proof.
        overlap: Overlap,
        /// An upper bound of the distance at the start: 0, or what the bodies exceed their shapes by, together.
        upper: f64,
    },
    /// A limit was reached before an answer.
    Unresolved {
        /// A lower bound of the distance at all times, the best that was proven; 0 if none was.
        lower: f64,
        /// The least distance that was seen: its time, and the nearest pieces then. None if a limit
        /// was reached before any was measured.
        nearest: Option<(f64, Contact)>,
        /// The limit.
        reason: Limit,
    },
}

impl ClosestApproach {
    /// A lower bound of the distance at all times; 0 if none is known.
    pub fn lower(&self) -> f64 {
        match *self {
            ClosestApproach::Nearest { lower, .. }
            | ClosestApproach::Farther { lower }
            | ClosestApproach::Unresolved { lower, .. } => lower,
            ClosestApproach::Nearer { .. } | ClosestApproach::Overlapping { .. } => 0.0,
        }
    }

    /// An upper bound of the least distance; infinite if none is known.
    pub fn upper(&self) -> f64 {
        match self {
            ClosestApproach::Overlapping { upper, .. } => *upper,
            _ => self
                .nearest()
                .map_or(f64::INFINITY, |(_, contact)| contact.separation.upper),
        }
    }

    /// The time of the upper bound, in the motions' unit; none if no distance was measured.
    pub fn time(&self) -> Option<f64> {
        match self {
            ClosestApproach::Overlapping { .. } => Some(0.0),
            _ => self.nearest().map(|(time, _)| time),
        }
    }

    /// The nearest pieces that were seen, and their time; none of bodies that overlap at the start.
    pub fn nearest(&self) -> Option<(f64, Contact)> {
        match *self {
            ClosestApproach::Nearest { time, contact, .. }
            | ClosestApproach::Nearer { time, contact } => Some((time, contact)),
            ClosestApproach::Unresolved { nearest, .. } => nearest,
            ClosestApproach::Farther { .. } | ClosestApproach::Overlapping { .. } => None,
        }
    }

    /// The answer for bodies that overlap at the start.
    pub(in crate::schedule) fn overlapping(overlap: Overlap) -> Self {
        ClosestApproach::Overlapping {
            overlap,
            upper: 0.0,
        }
    }

    /// Returns what an answer for bodies says of their shapes.
    fn of_shapes(self, excess: Excess) -> Self {
        let seen = |contact| excess.of_shapes(contact);
        match self {
            ClosestApproach::Nearest {
                lower,
                time,
                contact,
            } => ClosestApproach::Nearest {
                lower,
                time,
                contact: seen(contact),
            },
            ClosestApproach::Nearer { time, contact } => ClosestApproach::Nearer {
                time,
                contact: seen(contact),
            },
            ClosestApproach::Overlapping { overlap, .. } => ClosestApproach::Overlapping {
                overlap: match overlap {
                    Overlap::Pieces(contact) => Overlap::Pieces(seen(contact)),
                    Overlap::AInsideB(_) | Overlap::BInsideA(_) => overlap,
                },
                upper: excess.of_overlap(),
            },
            ClosestApproach::Unresolved {
                lower,
                nearest,
                reason,
            } => ClosestApproach::Unresolved {
                lower,
                nearest: nearest.map(|(time, contact)| (time, seen(contact))),
                reason,
            },
            ClosestApproach::Farther { .. } => self,
        }
    }

    /// Returns true if the bodies come to no distance after the start.
    pub(in crate::schedule) fn meets_later(&self, tolerance: f64) -> bool {
        match *self {
            ClosestApproach::Nearest { time, contact, .. } => {
                time > 0.0 && contact.separation.upper <= tolerance
            }
            _ => false,
        }
    }

    /// The width of the bracket; 0 if there is none.
    pub(in crate::schedule) fn width(&self) -> f64 {
        match self {
            ClosestApproach::Nearest { .. } => self.upper() - self.lower(),
            _ => 0.0,
        }
    }

    /// Compares the least distance to one that is required.
    ///
    /// Bodies that may touch keep no clearance, not even one of 0.
    pub fn clearance(&self, required: f64) -> Clearance {
        let (lower, upper) = (self.lower(), self.upper());
        if lower >= required && lower > 0.0 {
            Clearance::Kept
        } else if upper < required || upper <= 0.0 {
            Clearance::Violated
        } else {
            Clearance::Unverified
        }
    }
}

impl Answer<ClosestApproach> {
    /// Returns what an answer for bodies says of their shapes: once for each question that is asked.
    pub(in crate::schedule) fn of_shapes(self, excess: Excess) -> Self {
        let outcome = self.outcome.of_shapes(excess);
        Answer {
            outcome,
            tolerance: greater(self.tolerance, outcome.width()),
            ..self
        }
    }
}

/// The comparison of the least distance of two bodies to one that is required.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clearance {
    /// The bodies are never nearer, certainly.
    Kept,
    /// The bodies are nearer at some time, certainly.
    Violated,
    /// The least distance is not known well enough.
    Unverified,
}
