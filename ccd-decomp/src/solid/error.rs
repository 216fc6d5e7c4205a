//! Errors of meshes that do not bound a solid.

use super::topology::{Edge, Topology};
use crate::tally::Tally;
use crate::work::OutOfWork;
use ccd_core::limits::LEAST_COORDINATE;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The reason why a mesh cannot be decomposed exactly: it does not bound a solid, or not a convex one. Numbers are
/// those of the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error, Serialize, Deserialize)]
#[non_exhaustive]
pub enum DecomposeError {
    /// An edge does not have exactly two faces of opposite direction.
    #[error("{topology}; {}, or use triangles", .topology.advice())]
    NotManifold {
        /// The edges, by kind.
        topology: Box<Topology>,
    },
    /// Faces have no area.
    #[error("faces without area: {faces}; remove them, or use triangles")]
    NoArea {
        /// The faces.
        faces: Tally<u32>,
    },
    /// Faces intersect outside shared vertices and edges.
    #[error("faces that intersect: {pairs}; mend them, or use triangles")]
    SelfIntersecting {
        /// The pairs of faces, at most a thousand.
        pairs: Tally<Crossing>,
    },
    /// The solid is in front of a face, not behind it.
    #[error("the part with face {face} is inside out; turn its faces, or use triangles")]
    InsideOut {
        /// A face of the part.
        face: u32,
    },
    /// The volume of a part is too small to determine its orientation.
    #[error("the part with face {face} holds no volume to speak of; use triangles")]
    NoVolume {
        /// A face of the part.
        face: u32,
    },
    /// Every tested corner is on another part, so that the nesting of the part is unknown.
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
    /// The solid has several parts, and is therefore not convex.
    #[error("{parts} parts, each of which may be convex; use patches or triangles")]
    NotInOnePart {
        /// The number of parts.
        parts: u32,
    },
    /// The work budget did not suffice.
    #[error("use patches or a hull to have them however long it takes, or triangles")]
    TooLong,
    /// A coordinate is too near to 0 for exact predicates.
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

/// Two faces of a mesh, by number, that intersect outside shared vertices and edges.
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
