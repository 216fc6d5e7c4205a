//! The input format of the nodes of a hull tree.

use super::loops::PolygonList;
use glam::DVec3;

/// A node of a hull tree, as input of [`HullTree::new`](super::HullTree::new).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum HullNode {
    /// A leaf, with the index of its piece.
    Leaf(u32),
    /// An inner node, with the indices of its two children and the convex hull of both.
    Inner([u32; 2], Hull),
}

/// The convex hull of an inner node's children: corners and facets.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hull {
    /// The corners of the hull, in the body's frame.
    pub points: Vec<DVec3>,
    /// The facets, as loops of indices into the points, counterclockwise seen from outside. They are convex polygons,
    /// no two of them coplanar, that close the hull. A flat polygon has two facets; a hull of one or two points has
    /// none.
    pub facets: PolygonList,
}

/// The class of a hull's facet: whether it lies on the mesh, on a piece, or on neither; better classes come first.
///
/// If neither of the nearest features of two nodes is a [`Bridge`](FacetClass::Bridge), both belong to pieces. The
/// distance of the nodes is then that of the pieces below them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FacetClass {
    /// The facet is part of the mesh.
    OnMesh,
    /// The facet belongs to pieces but not to the mesh: it closes a piece inside the solid.
    InsideSolid,
    /// The facet bridges a gap between pieces, outside all of them.
    Bridge,
}
