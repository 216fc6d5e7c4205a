//! The input format of a node of a hull tree.

use super::loops::Loops;
use glam::DVec3;

/// A node of a hull tree, in the input format.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum HullNode {
    /// One piece, by its index.
    Leaf(u32),
    /// Two nodes, by their indices, and the hull of both.
    Inner([u32; 2], Hull),
}

/// A convex hull without a rounding radius.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hull {
    /// The corners of the hull.
    pub points: Vec<DVec3>,
    /// The facets, as loops of indices into the points, counterclockwise seen from outside. They are convex polygons,
    /// no two of them coplanar, that close the hull. A flat polygon has two facets; a hull of one or two points has
    /// none.
    pub facets: Loops,
}

/// The class of a part of a node's surface, by the pieces below; better classes come first.
///
/// The nearest features of two nodes that are both not [`Free`](FacetClass::Free) belong to pieces:
/// no pair of pieces below is nearer, or farther.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FacetClass {
    /// A part of the mesh.
    Original,
    /// A part of pieces, but not of the mesh: it closes a piece inside the solid.
    Contained,
    /// A bridge between pieces, outside of all of them.
    Free,
}
