//! What a [`Body`](crate::Body) is made of and what it tells of itself, beyond the simple shapes.

pub use ccd_core::{
    Combination, Enclosure, Face, Facet, FacetOrigin, Hierarchy, HierarchyNode, Piece, Pieces,
    Polytope, SolidOfRevolution, SweptBox, Volume,
};
