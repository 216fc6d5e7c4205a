//! What can be wrong with a mesh that is to bound a solid.

use super::topology::{Edge, Topology};
use crate::tally::Tally;
use crate::work::OutOfWork;
use ccd_core::tolerance::LEAST_COORDINATE;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Why a mesh cannot be decomposed exactly: it does not bound a solid. Faces, edges and vertices by
/// their numbers in the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error, Serialize, Deserialize)]
#[non_exhaustive]
pub enum DecomposeError {
    /// Its edges do not have one face on either side.
    #[error("{topology}; {}, or use triangles", .topology.advice())]
    NotManifold {
        /// Which edges.
        topology: Box<Topology>,
    },
    /// Faces without area have no inner side.
    #[error("faces without area: {faces}; remove them, or use triangles")]
    NoArea {
        /// The faces.
        faces: Tally<u32>,
    },
    /// Faces meet that share no vertex or edge there.
    #[error("faces that intersect: {pairs}; mend them, or use triangles")]
    SelfIntersecting {
        /// The pairs of faces, a thousand at most: there may be more.
        pairs: Tally<Crossing>,
    },
    /// The solid is in front of a face, not behind it.
    #[error("the part with face {face} is inside out; turn its faces, or use triangles")]
    InsideOut {
        /// A face of the part.
        face: u32,
    },
    /// A part's volume is too small to tell its inside.
    #[error("the part with face {face} holds no volume to speak of; use triangles")]
    NoVolume {
        /// A face of the part.
        face: u32,
    },
    /// Every corner that was looked at is one of another part, too, so that what surrounds the part
    /// cannot be told.
    #[error(
        "the part with face {face} touches other parts at its corners; take the parts for themselves, or use triangles"
    )]
    Entangled {
        /// A face of the part.
        face: u32,
    },
    /// It is not convex.
    #[error("not convex at {edge}; use patches or triangles")]
    NotConvex {
        /// An edge at which the solid's angle is more than half a turn.
        edge: Edge,
    },
    /// It is not convex, as it is not in one part.
    #[error("{parts} parts, each of which may be convex; use patches or triangles")]
    NotInOnePart {
        /// How many parts.
        parts: u32,
    },
    /// Only as much may be spent as was allowed for, and that did not suffice to tell.
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
