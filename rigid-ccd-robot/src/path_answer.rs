//! The answer to a question about a path. All questions have the same type of answer.

use crate::cell::Item;
use crate::error::PathError;
use crate::path_point::PathPoint;
use rigid_ccd::Error;
use rigid_ccd::answer::{ClearanceVerdict, Feature, Limit, Unresolved};
use rigid_ccd::glam::DVec3;

/// The answer to a question about a path: its outcome and its accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathAnswer<'c> {
    /// The result: free, a contact, a least distance, or a limit that was reached.
    pub outcome: PathOutcome<'c>,
    /// The point before which nothing touches: the end of a free path, the point of a first contact, or the point up
    /// to which the search proved the path free before it reached a limit. The start of the path for any other contact
    /// and for a distance.
    pub free_until: PathPoint,
    /// The tolerance that the answer meets. It is the tolerance of the settings, unless rounding of positions makes it
    /// larger, far from the base or after thousands of turns.
    ///
    /// The distance of a contact is at most margin + tolerance. The bounds of a least distance differ by at most the
    /// tolerance plus the [excess](rigid_ccd::Body::excess) of both nearest bodies, unless a limit is reached. Both
    /// statements hold to within a thousandth of the tolerance. The tolerance does not affect proofs that a path is
    /// free.
    pub tolerance: f64,
}

/// The outcome of a question about a path.
///
/// | question | outcomes |
/// |---|---|
/// | first contact, any contact | free, contact, unresolved |
/// | closest approach | least distance, unresolved |
///
/// The enum is exhaustive on purpose: a wildcard arm could treat an unresolved path as a free one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathOutcome<'c> {
    /// Nothing touches on the whole path.
    Free,
    /// A pair touches at a point of the path.
    Contact(PathContact<'c>),
    /// The least distance of any pair on the path.
    LeastDistance {
        /// A lower bound of the distances of all pairs on the whole path.
        lower: f64,
        /// An upper bound of the least distance; infinite if no distance was measured.
        upper: f64,
        /// The nearest pair; `None` if no pair was measured.
        nearest: Option<PathContact<'c>>,
    },
    /// A limit was reached before the answer was known.
    Unresolved(UnresolvedPath<'c>),
}

/// The bounds that are proven when a limit is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnresolvedPath<'c> {
    /// The limit.
    pub limit: Limit,
    /// A lower bound of the least distance; 0 for a question about contacts.
    pub lower: f64,
    /// An upper bound of the least distance; infinite for a question about contacts or if no distance was measured.
    pub upper: f64,
    /// The nearest measured pair; `None` for a question about contacts or if no distance was measured.
    pub nearest: Option<PathContact<'c>>,
}

/// A pair of items at a point of a path, where it touches or is nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathContact<'c> {
    /// The point of the path.
    pub at: PathPoint,
    /// The items of the pair. A link or an attached body comes first.
    pub items: [Item<'c>; 2],
    /// The nearest points of both bodies, in the base frame. For overlapping bodies, points of two intersecting
    /// pieces. `None` if the deadline passed before they were computed.
    pub witnesses: Option<[DVec3; 2]>,
    /// The feature of each mesh (vertex, edge or face) that contains its witness, with the mesh's index. `None` for a
    /// convex body, which may be the hull of a mesh, and if one body is inside the other.
    pub features: [Option<Feature>; 2],
    /// Bounds of the pair's distance at this point, including rounding errors; 0 for overlapping bodies.
    pub distance_bounds: [f64; 2],
}

impl<'c> PathAnswer<'c> {
    /// Returns whether nothing touches before the contact or limit. True for answers about the first contact, false
    /// for answers about a distance.
    pub fn is_free_until_contact(&self) -> bool {
        match &self.outcome {
            PathOutcome::Free | PathOutcome::Unresolved(_) => true,
            PathOutcome::Contact(contact) => contact.at == self.free_until,
            PathOutcome::LeastDistance { .. } => false,
        }
    }

    /// Returns the contact; `None` if the path is free.
    ///
    /// # Errors
    /// [`Error::Unresolved`] if a limit was reached, and [`PathError::NoContactAsked`] for a distance.
    pub fn contact(&self) -> Result<Option<PathContact<'c>>, PathError> {
        match self.outcome {
            PathOutcome::Free => Ok(None),
            PathOutcome::Contact(contact) => Ok(Some(contact)),
            PathOutcome::LeastDistance { .. } => Err(PathError::NoContactAsked),
            PathOutcome::Unresolved(known) => {
                let known = Unresolved::from_safe_until(self.free_until.time(), known.limit);
                Err(Error::from(known).into())
            }
        }
    }
}

impl<'c> PathOutcome<'c> {
    /// Creates the outcome of a question about contacts that reached a limit.
    pub(crate) fn unresolved_contact(limit: Limit) -> Self {
        PathOutcome::Unresolved(UnresolvedPath {
            limit,
            lower: 0.0,
            upper: f64::INFINITY,
            nearest: None,
        })
    }

    /// Returns a lower bound of the least distance on the path; 0 if none is known.
    pub fn lower(&self) -> f64 {
        match *self {
            PathOutcome::LeastDistance { lower, .. } => lower,
            PathOutcome::Unresolved(known) => known.lower,
            PathOutcome::Free | PathOutcome::Contact(_) => 0.0,
        }
    }

    /// Returns an upper bound of the least distance on the path; infinite if none is known.
    pub fn upper(&self) -> f64 {
        match *self {
            PathOutcome::LeastDistance { upper, .. } => upper,
            PathOutcome::Unresolved(known) => known.upper,
            PathOutcome::Contact(contact) => contact.distance_bounds[1],
            PathOutcome::Free => f64::INFINITY,
        }
    }

    /// Returns the pair that touches or is nearest, if any was found.
    pub fn nearest(&self) -> Option<PathContact<'c>> {
        match *self {
            PathOutcome::Free => None,
            PathOutcome::Contact(contact) => Some(contact),
            PathOutcome::LeastDistance { nearest, .. } => nearest,
            PathOutcome::Unresolved(known) => known.nearest,
        }
    }

    /// Returns the limit that ended the search; `None` if the question was answered.
    pub fn limit(&self) -> Option<Limit> {
        match self {
            PathOutcome::Unresolved(known) => Some(known.limit),
            _ => None,
        }
    }

    /// Compares the bounds of the least distance with a required clearance.
    ///
    /// If the lower bound is 0, the bodies may touch: then no clearance is kept, not even 0.
    pub fn clearance_verdict(&self, required: f64) -> ClearanceVerdict {
        ClearanceVerdict::from_bounds([self.lower(), self.upper()], required)
    }
}

#[cfg(test)]
mod tests;
