//! The types that a [`Body`](crate::Body) is made of, such as convex pieces, and those that its methods take or return.

pub use ccd_core::{
    ConvexCombination, Enclosure, Face, Facet, FacetOrigin, Hierarchy, HierarchyNode, Piece,
    Pieces, Polytope, SolidOfRevolution, SweptBox, Volume,
};
