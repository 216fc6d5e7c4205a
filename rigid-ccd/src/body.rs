//! What a [`Body`](crate::Body) is made of and what it tells of itself, beyond the simple shapes.

pub use ccd_core::{
    Combination, Enclosure, Face, Facet, Hierarchy, HierarchyNode, Origin, Piece, Pieces, Polytope,
    Round, SweptBox, Volume,
};
