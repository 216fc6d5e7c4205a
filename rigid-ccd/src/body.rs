//! The types that a [`Body`](crate::Body) is made of, such as convex pieces, and those that its methods take or return.

pub use ccd_core::{
    ConvexCombination, EnclosingPolytope, Facet, FacetOrigin, Hierarchy, HierarchyNode, MeshFace,
    Piece, Pieces, Polytope, SolidOfRevolution, Solidity, SweptBox,
};
