//! Errors of a mesh that is to bound a solid.

use super::topology::{Edge, Topology};
use crate::tally::Tally;
use crate::work::OutOfWork;
use ccd_core::limits::LEAST_COORDINATE;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The reason why a mesh cannot be decomposed exactly: it does not bound a solid, or not a convex one. Faces,
/// edges and vertices have their numbers in the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error, Serialize, Deserialize)]
#[non_exhaustive]
pub enum DecomposeError {
    /// An edge does not have one face on either side.
    #[error("{topology}; {}, or use triangles", .topology.advice())]
    NotManifold {
        /// The edges, by kind.
        topology: Box<Topology>,
    },
    /// Faces have no area, and therefore no inner side.
    #[error("faces without area: {faces}; remove them, or use triangles")]
    NoArea {
        /// The faces.
        faces: Tally<u32>,
    },
    /// Faces meet elsewhere than in a vertex or edge that they share.
    #[error("faces that intersect: {pairs}; mend them, or use triangles")]
    SelfIntersecting {
        /// The pairs of faces; counting ends at a thousand.
        pairs: Tally<Crossing>,
    },
    /// The solid is in front of a face, not behind it.
    #[error("the part with face {face} is inside out; turn its faces, or use triangles")]
    InsideOut {
        /// A face of the part.
        face: u32,
    },
    /// The volume of a part is too small to decide on which side its inside is.
    #[error("the part with face {face} holds no volume to speak of; use triangles")]
    NoVolume {
        /// A face of the part.
        face: u32,
    },
    /// Every corner that was tried is a corner of another part, too, so that the surroundings of the part are
    /// unknown.
    #[error(
        "the part with face {face} touches other parts at its corners; take the parts for themselves, or use triangles"
    )]
    Entangled {
        /// A face of the part.
        face: u32,
    },
    /// The solid is not convex.
    #[error("not convex at {edge}; use patches or triangles")]
    NotConvex {
        /// An edge at which the solid's angle is more than half a turn.
        edge: Edge,
    },
    /// The solid is in several parts, and therefore not convex.
    #[error("{parts} parts, each of which may be convex; use patches or triangles")]
    NotInOnePart {
        /// The number of parts.
        parts: u32,
    },
    /// The budget of work did not suffice to decide.
    #[error("use patches or a hull to have them however long it takes, or triangles")]
    TooLong,
    /// A coordinate is too near to 0 for exact computations.
    #[error("vertex {vertex} has a coordinate nearer to 0 than {LEAST_COORDINATE:e}; make it 0")]
    TooFine {
        /// The vertex.
        vertex: usize,
    },
}

impl From<OutOfWork> for DecomposeError {
    fn from(OutOfWork: OutOfWork) -> Self {
        DecomposeError::TooLong
    }
}

/// Two faces of a mesh, by their numbers, that meet elsewhere than in a shared vertex or edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Crossing {
    /// The smaller number.
    pub face: u32,
    /// The other one.
    pub other: u32,
}

impl fmt::Display for Crossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "f{}-f{}", self.face, self.other)
    }
}
