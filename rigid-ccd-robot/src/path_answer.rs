//! The answer to a question about a path: one type for all questions.

use crate::cell::Item;
use crate::error::PathError;
use crate::path_point::PathPoint;
use rigid_ccd::Error;
use rigid_ccd::answer::{ClearanceVerdict, Feature, Limit, Unresolved};
use rigid_ccd::glam::DVec3;

/// What a question about a path has found, and how accurate it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathAnswer<'c> {
    /// Free, a contact, a distance, or the limit that ended the search.
    pub outcome: PathOutcome<'c>,
    /// Nothing touches before this point: the end of a free path, the point of a first contact, or what was proven when a limit was
    /// reached. It is the start of the path for any other contact, and for a distance, which knows no margin.
    pub free_until: PathPoint,
    /// The tolerance that the answer meets. It is that of the settings, unless the rounding of positions allows only a larger one:
    /// far from the base, or after thousands of turns.
    ///
    /// A contact is within this distance beyond the margin. The bounds of a least distance differ by at most as much, and by what
    /// the nearest bodies [exceed](rigid_ccd::Body::excess) their shapes by, unless a limit is reached. Both hold to within a
    /// thousandth of the tolerance. That nothing touches holds without any tolerance.
    pub tolerance: f64,
}

/// What was found on a path.
///
/// | question | outcomes |
/// |---|---|
/// | first contact, any contact | free, contact, unresolved |
/// | closest approach | least distance, unresolved |
///
/// It is exhaustive, so that no program takes an outcome that it does not know for another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathOutcome<'c> {
    /// Nothing touches on the whole path.
    Free,
    /// A pair touches.
    Contact(PathContact<'c>),
    /// The least distance of all pairs on the path.
    LeastDistance {
        /// A lower bound of the distance of all pairs at all points of the path.
        lower: f64,
        /// An upper bound of the least distance; infinite if no distance was measured.
        upper: f64,
        /// The nearest pair that was found; `None` if no pair was measured.
        nearest: Option<PathContact<'c>>,
    },
    /// A limit was reached before the answer was known.
    Unresolved(UnresolvedPath<'c>),
}

/// What was known about a path when a limit was reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnresolvedPath<'c> {
    /// The limit.
    pub limit: Limit,
    /// A lower bound of the distance, if that was asked for; else 0.
    pub lower: f64,
    /// An upper bound of the distance, if that was asked for and measured; else infinite.
    pub upper: f64,
    /// The nearest pair that was found, if a distance was asked for and measured.
    pub nearest: Option<PathContact<'c>>,
}

/// A pair of a cell at a point of a path, where it is in contact or nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathContact<'c> {
    /// Where on the path. Nothing touches before the first contact.
    pub at: PathPoint,
    /// The pair; a link or an attached body comes first.
    pub items: [Item<'c>; 2],
    /// The nearest points of both, in the frame of the base. If both overlap they are points of two pieces that intersect. `None`
    /// if the deadline passes before they are found.
    pub witnesses: Option<[DVec3; 2]>,
    /// The vertex, edge or face of each mesh that its witness is on, numbered as in the body. `None` for a convex body, whose
    /// mesh may be its hull, and if one body is inside the other.
    pub features: [Option<Feature>; 2],
    /// Bounds of the distance of the pair there, the rounding of computed poses included; 0 if both overlap.
    pub distance_bounds: [f64; 2],
}

impl<'c> PathAnswer<'c> {
    /// Returns whether nothing touches before what was found: that is so for the answer about the first contact, and for no answer
    /// about a distance.
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
    /// [`Error::Unresolved`] if a limit was reached first, and [`PathError::NoContactAsked`] for a distance.
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
    /// Creates the outcome of a question about contacts that a limit ended.
    pub(crate) fn unresolved_contact(limit: Limit) -> Self {
        PathOutcome::Unresolved(UnresolvedPath {
            limit,
            lower: 0.0,
            upper: f64::INFINITY,
            nearest: None,
        })
    }

    /// Returns a lower bound of the distance on the path; 0 if none is known.
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

    /// Returns the pair that touches or is nearest, if one was found.
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

    /// Returns whether all pairs stay at least the required distance apart, as far as the bounds of the least distance tell.
    ///
    /// Pairs that may touch keep no clearance, not even a clearance of 0.
    pub fn clearance_verdict(&self, required: f64) -> ClearanceVerdict {
        ClearanceVerdict::from_bounds([self.lower(), self.upper()], required)
    }
}

#[cfg(test)]
mod tests;
