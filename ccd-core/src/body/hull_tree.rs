//! The convex hull tree: a hull at every node, the pieces at the leaves `[FAST06 §3.3]`.

mod assemble;
mod bottom_up;
mod convex;
mod edges;
mod error;
mod identity;
mod inherit;
mod inside;
mod loops;
mod node;
mod renumber;
#[cfg(feature = "serde")]
mod serial;
#[cfg(test)]
mod tests;

pub use error::{HullFault, HullTreeError};
pub use loops::Loops;

use super::combination::Combination;
use super::hierarchy::{Hierarchy, HierarchyNode};
use super::piece::Piece;
use super::pieces::{Pieces, range};
pub(crate) use convex::support_of;
use glam::DVec3;
use std::sync::Arc;

/// A binary tree over the pieces of a body with the convex hull of what is below at every node
/// `[SWIFT01]`.
///
/// # Guarantee
/// - A leaf's hull is its piece.
/// - An inner hull is that of its children's points, exactly: each of its points is one of theirs,
///   and each of theirs is inside of it. Both are checked when the tree is made, with exact
///   arithmetic `[SHE97]`, so that the distance of two nodes never exceeds that of any two pieces
///   below them.
/// - Where the nearest features of two nodes are [not free](FacetClass::Free), their distance is that
///   of the pieces below them.
///
/// A node is grown by the largest rounding radius of the pieces below.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "serial::Stored", into = "serial::Stored")
)]
pub struct HullTree {
    hierarchy: Hierarchy,
    /// Clones share them, whatever their leaves call the pieces.
    hulls: Arc<Hulls>,
}

/// The hulls of all nodes, in the hierarchy's order.
#[derive(Debug)]
struct Hulls {
    pieces: Pieces,
    /// What the facets of all hulls are, in order.
    classes: Vec<FacetClass>,
    /// Where each hull's facets end.
    class_ends: Vec<u32>,
    /// Whether all pieces below a node have the node's rounding radius.
    evenly_rounded: Vec<bool>,
    /// Half the diagonal of each hull's box, rounding included.
    sizes: Vec<f64>,
    /// The facets that meet in each point of all hulls, counted within its hull, in order.
    meeting: Vec<u32>,
    /// Where each point's facets end.
    meeting_ends: Vec<u32>,
}

/// What a node is made of.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum HullNode {
    /// One piece, by its index.
    Leaf(u32),
    /// Two nodes, by their indices, and the hull of both.
    Inner([u32; 2], Hull),
}

/// A convex hull without any rounding.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hull {
    /// Its corners.
    pub points: Vec<DVec3>,
    /// Loops of indices into the points, counter-clockwise seen from outside: convex polygons, no
    /// two of them coplanar, that close the hull. A flat polygon has two; a hull of one or two points
    /// has none.
    pub facets: Loops,
}

/// What a part of a node's surface is of the pieces below; the better one comes first.
///
/// The nearest features of two nodes that are both not [`Free`](FacetClass::Free) belong to pieces:
/// no pair of pieces below is nearer, or farther.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FacetClass {
    /// A part of the mesh.
    Original,
    /// A part of pieces that is not of the mesh: it closes a piece inside the solid.
    Contained,
    /// A bridge between pieces, with nothing behind it.
    Free,
}

impl HullTree {
    /// Makes a tree over pieces; node 0 is the root.
    ///
    /// # Errors
    /// [`HullTreeError`] names the node, and what of the [guarantee](HullTree) fails there.
    ///
    /// # Complexity
    /// O(n log n) in all points and facets, where few of the points that a hull hides are near each of
    /// its facets.
    pub fn new(pieces: &Pieces, nodes: &[HullNode]) -> Result<Self, HullTreeError> {
        assemble::assemble(pieces, nodes)
    }

    /// The nodes, the root first; leaves name pieces.
    pub fn hierarchy(&self) -> &Hierarchy {
        &self.hierarchy
    }

    /// The hulls of all nodes, in their order: whatever works on pieces works on nodes. Features of an
    /// inner hull have the names that they have in the mesh, as far as they are of it.
    pub fn hulls(&self) -> &Pieces {
        &self.hulls.pieces
    }

    /// What the facets of a node's hull are, in their order.
    ///
    /// # Panics
    /// When there is no such node.
    pub fn facet_classes(&self, node: u32) -> &[FacetClass] {
        &self.hulls.classes[range(&self.hulls.class_ends, node as usize)]
    }

    /// What the feature is that holds a combination of a node's points: the best of the facets that
    /// meet there `[SWIFT01]`.
    ///
    /// # Guarantee
    /// Unless [`FacetClass::Free`], the combination lies on a piece below the node, or within one.
    ///
    /// # Panics
    /// When there is no such node.
    pub fn class_of(&self, node: u32, point: &Combination) -> FacetClass {
        let at = node as usize;
        let support = point.support();
        if support.is_empty() || !self.hulls.evenly_rounded[at] {
            return FacetClass::Free;
        }
        if support.len() == 1 {
            return FacetClass::Original;
        }
        let inside = match self.hierarchy.nodes()[at] {
            HierarchyNode::Leaf(_) if self.facet_classes(node).is_empty() => FacetClass::Original,
            HierarchyNode::Leaf(_) => FacetClass::Contained,
            HierarchyNode::Inner(..) => FacetClass::Free,
        };
        let (first, others) = (self.hulls.meeting(at, support[0]), &support[1..]);
        let holding = first.iter().filter(|facet| {
            let holds = |&v| self.hulls.meeting(at, v).contains(facet);
            others.iter().all(holds)
        });
        let classes = self.facet_classes(node);
        let class = |&facet: &u32| classes[facet as usize];
        holding.map(class).min().unwrap_or(inside)
    }

    /// A node's hull; where it has many points, these are found along a direction by climbing edges,
    /// once these are proven to be those of the hull, else by searching a tree.
    pub(crate) fn hull(&self, node: u32) -> Piece<'_> {
        self.hulls.pieces.get(node as usize).supported(support_of)
    }

    /// The nodes that the tree can be [made](HullTree::new) of again.
    pub fn to_nodes(&self) -> Vec<HullNode> {
        let inner = |at: usize, children: [u32; 2]| {
            let hull = self.hulls.pieces.get(at);
            let facets = hull.facets.iter().collect();
            let points = hull.points.to_vec();
            HullNode::Inner(children, Hull { points, facets })
        };
        let nodes = self.hierarchy.nodes().iter().enumerate();
        nodes
            .map(|(at, node)| match *node {
                HierarchyNode::Leaf(piece) => HullNode::Leaf(piece),
                HierarchyNode::Inner(left, right) => inner(at, [left, right]),
            })
            .collect()
    }

    /// Half the diagonal of a node's box, rounding included.
    #[inline]
    pub(crate) fn size(&self, node: u32) -> f64 {
        self.hulls.sizes[node as usize]
    }

    /// Bytes held, about.
    pub(crate) fn bytes(&self) -> usize {
        self.hulls.bytes()
    }

    /// The same tree with leaves that name the same pieces in another list.
    ///
    /// # Errors
    /// [`HullFault::NotAPiece`] at a leaf that is none of them.
    pub(crate) fn renumbered(self, pieces: &Pieces) -> Result<Self, HullTreeError> {
        let hierarchy = renumber::renumber(&self, pieces)?;
        Ok(HullTree { hierarchy, ..self })
    }
}

impl Hulls {
    /// The facets of a node's hull that meet in one of its points; none when there is no such point.
    fn meeting(&self, node: usize, point: u32) -> &[u32] {
        let points = self.pieces.point_range(node);
        let at = points.start + point as usize;
        if !points.contains(&at) {
            return &[];
        }
        &self.meeting[range(&self.meeting_ends, at)]
    }

    fn bytes(&self) -> usize {
        let meeting = 4 * (self.meeting.len() + self.meeting_ends.len());
        self.pieces.bytes() + self.classes.len() + 25 * self.sizes.len() + meeting
    }
}
