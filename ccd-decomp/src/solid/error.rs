//! Errors of meshes that do not bound a solid.

use super::topology::{Edge, TopologyDefects};
use crate::tally::CountWithExamples;
use crate::work::WorkBudgetExhausted;
use ccd_core::limits::LEAST_NONZERO_COORDINATE;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The reason why a mesh cannot be decomposed exactly: it does not bound a solid, or not a convex one. Numbers are
/// those of the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error, Serialize, Deserialize)]
#[non_exhaustive]
pub enum DecomposeError {
    /// An edge does not have exactly two faces that run along it in opposite directions.
    #[error("{topology}; {}, or use triangles or an outer hull", .topology.advice())]
    NotManifold {
        /// The irregular edges of the mesh, by kind.
        topology: Box<TopologyDefects>,
    },
    /// Some faces of the mesh have no area.
    #[error("faces without area: {faces}; remove them, or use triangles")]
    ZeroAreaFaces {
        /// The numbers of the faces without area.
        faces: CountWithExamples<u32>,
    },
    /// Faces intersect outside shared vertices and edges.
    #[error("faces that intersect: {pairs}; mend them, or use triangles")]
    SelfIntersecting {
        /// The pairs of intersecting faces, at most a thousand.
        pairs: CountWithExamples<Crossing>,
    },
    /// The solid is in front of a face, not behind it.
    #[error("the part with face {face} is inside out; turn its faces, or use triangles")]
    InsideOut {
        /// The number of a face of the part that is inside out.
        face: u32,
    },
    /// The volume of a part is too small to determine its orientation.
    #[error("the part with face {face} holds no volume to speak of; use triangles")]
    NoVolume {
        /// The number of a face of the part without volume.
        face: u32,
    },
    /// It is unknown which other parts surround a part, because every ray tried from its corners starts on another part
    /// or meets an edge of it.
    #[error(
        "the part with face {face} touches other parts at its corners; take the parts for themselves, or use triangles"
    )]
    UnknownNesting {
        /// The number of a face of the part whose nesting is unknown.
        face: u32,
    },
    /// The mesh was to be one convex piece, but an edge of it is reflex.
    #[error("not convex at {edge}; use patches or triangles")]
    NotConvex {
        /// An edge at which the interior dihedral angle exceeds half a turn.
        edge: Edge,
    },
    /// The solid has several parts, and is therefore not convex.
    #[error("{parts} parts, each of which may be convex; use patches or triangles")]
    NotConnected {
        /// The number of parts of the solid.
        parts: u32,
    },
    /// The work budget was spent before the checks were complete.
    #[error("use patches or a hull to have them however long it takes, or triangles")]
    WorkBudgetExceeded,
    /// A coordinate is too near to 0 for exact predicates.
    #[error(
        "vertex {vertex} has a coordinate nearer to 0 than {LEAST_NONZERO_COORDINATE:e}; make it 0"
    )]
    CoordinateNearZero {
        /// The number of the vertex with that coordinate.
        vertex: usize,
    },
}

impl From<WorkBudgetExhausted> for DecomposeError {
    fn from(WorkBudgetExhausted: WorkBudgetExhausted) -> Self {
        DecomposeError::WorkBudgetExceeded
    }
}

/// Two faces of a mesh, by number, that intersect outside shared vertices and edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Crossing {
    /// The smaller of the two face numbers.
    pub face: u32,
    /// The larger of the two face numbers.
    pub other: u32,
}

impl fmt::Display for Crossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "f{}-f{}", self.face, self.other)
    }
}
