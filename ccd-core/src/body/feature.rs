//! Vertices, edges and faces of a body, numbered as in its mesh.

use std::fmt;

/// A feature of a body, numbered from 0 as in the body's mesh.
///
/// A feature prints as `v7`, `e3-7`, `f12` or `p0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Feature {
    /// A vertex, by its number.
    Vertex(u32),
    /// The edge between two vertices, the smaller number first.
    Edge(u32, u32),
    /// A face, by its number.
    Face(u32),
    /// A whole piece, by its index, if the point is inside the piece or its facets are unknown.
    Piece(u32),
}

impl Feature {
    /// Returns the edge between two vertices, or the vertex when both are the same.
    pub fn edge(v: u32, w: u32) -> Self {
        if v == w {
            Feature::Vertex(v)
        } else {
            Feature::Edge(v.min(w), v.max(w))
        }
    }
}

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Feature::Vertex(v) => write!(f, "v{v}"),
            Feature::Edge(v, w) => write!(f, "e{v}-{w}"),
            Feature::Face(face) => write!(f, "f{face}"),
            Feature::Piece(piece) => write!(f, "p{piece}"),
        }
    }
}
