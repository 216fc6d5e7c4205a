//! The convex hull tree: every node has the convex hull of the pieces below it `[FAST06 §3.3]`.

mod assemble;
mod bottom_up;
pub(crate) mod convex;
mod edges;
mod error;
mod hull;
mod identity;
mod inherit;
mod inside;
mod loops;
mod node;
mod renumber;
#[cfg(feature = "serde")]
mod serial;

pub use error::{HullFault, HullTreeError};
pub use hull::{FacetClass, Hull, HullNode};
pub use loops::PolygonList;

use super::adjacency::AdjacencyLists;
use super::facets::range_from_ends;
use super::hierarchy::{Hierarchy, HierarchyNode};
use super::piece::{ConvexCombination, Piece};
use super::pieces::Pieces;
use convex::build_support_map;
use std::sync::Arc;

/// A binary tree over the pieces of a body in which every node has the convex hull of all pieces below it `[SWIFT01]`.
///
/// # Guarantee
/// - A leaf's hull is its piece.
/// - The hull of an inner node is exactly that of its children's points: each of its points is one of theirs, and
///   each of theirs is inside it. Construction checks both with exact arithmetic `[SHE97]`. The distance of two nodes
///   therefore never exceeds that of any two pieces below them.
/// - If neither of the nearest features of two nodes is a [bridge](FacetClass::Bridge), the distance of the nodes is
///   that of the pieces below them.
///
/// A node is grown by the largest rounding radius of the pieces below.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "serial::StoredHullTree", into = "serial::StoredHullTree")
)]
pub struct HullTree {
    hierarchy: Hierarchy,
    /// The hulls of all nodes, which clones of the tree share even if their leaves number the pieces differently.
    hulls: Arc<Hulls>,
}

/// The hulls of all nodes in the order of the hierarchy's nodes, with data on their facets.
#[derive(Debug)]
struct Hulls {
    pieces: Pieces,
    /// The class of each facet, for the facets of all hulls one after the other.
    facet_classes: Vec<FacetClass>,
    /// The end of each hull's facets in `facet_classes`.
    facet_class_ends: Vec<u32>,
    /// For each node, whether all pieces below it have the same rounding radius.
    has_uniform_radius_by_node: Vec<bool>,
    /// Half the diagonal of each hull's bounding box, rounding included.
    half_diagonals: Vec<f64>,
    /// The facets that meet in each point of all hulls, as indices among the facets of the point's hull.
    facets_by_point: AdjacencyLists<u32>,
}

impl HullTree {
    /// Returns the tree's nodes, the root first; the leaves refer to the body's pieces.
    pub fn hierarchy(&self) -> &Hierarchy {
        &self.hierarchy
    }

    /// Returns the hulls of all nodes as pieces, in the order of the nodes. Features of an inner hull have their names
    /// in the mesh if they are part of it.
    pub fn hulls(&self) -> &Pieces {
        &self.hulls.pieces
    }

    /// Returns the class of each facet of a node's hull, in the order of the facets.
    ///
    /// # Panics
    /// When there is no such node.
    pub fn facet_classes(&self, node: u32) -> &[FacetClass] {
        &self.hulls.facet_classes[range_from_ends(&self.hulls.facet_class_ends, node as usize)]
    }

    /// Returns the class of the facet that contains `point` on a node's hull `[SWIFT01]`; of several facets, the class
    /// that is first in the order of [`FacetClass`].
    ///
    /// `point` is a combination of the hull's points; each of these points by itself counts as on the mesh. If the
    /// pieces below the node have different rounding radii, the class is [`FacetClass::Bridge`].
    ///
    /// # Guarantee
    /// Unless the class is [`FacetClass::Bridge`], the combination is on or in a piece below the node.
    ///
    /// # Panics
    /// When there is no such node.
    pub fn facet_class_at(&self, node: u32, point: &ConvexCombination) -> FacetClass {
        let at = node as usize;
        let support = point.point_indices();
        if support.is_empty() || !self.hulls.has_uniform_radius_by_node[at] {
            return FacetClass::Bridge;
        }
        if support.len() == 1 {
            return FacetClass::OnMesh;
        }
        let inside = match self.hierarchy.nodes()[at] {
            HierarchyNode::Leaf(_) if self.facet_classes(node).is_empty() => FacetClass::OnMesh,
            HierarchyNode::Leaf(_) => FacetClass::InsideSolid,
            HierarchyNode::Inner(..) => FacetClass::Bridge,
        };
        let (first, others) = (self.hulls.facets_by_point(at, support[0]), &support[1..]);
        let holding = first.iter().filter(|facet| {
            let holds = |&v| self.hulls.facets_by_point(at, v).contains(facet);
            others.iter().all(holds)
        });
        let classes = self.facet_classes(node);
        let class = |&facet: &u32| classes[facet as usize];
        holding.map(class).min().unwrap_or(inside)
    }

    /// Returns the hull of a node, with a search structure for extremal points. Edges are climbed if they are proven to
    /// be those of the hull. Otherwise a tree is searched.
    pub(crate) fn hull(&self, node: u32) -> Piece<'_> {
        self.hulls
            .pieces
            .get(node as usize)
            .with_support_map(build_support_map)
    }

    /// Returns the input nodes from which the tree can be [built](HullTree::new) again.
    pub fn to_nodes(&self) -> Vec<HullNode> {
        let nodes = self.hierarchy.nodes().iter().zip(self.hulls.pieces.iter());
        let nodes = nodes.map(|(node, hull)| match *node {
            HierarchyNode::Leaf(piece) => HullNode::Leaf(piece),
            HierarchyNode::Inner(left, right) => {
                let (points, facets) = (hull.points.to_vec(), hull.facets.iter().collect());
                HullNode::Inner([left, right], Hull { points, facets })
            }
        });
        nodes.collect()
    }

    /// Returns half the diagonal of a node's bounding box, rounding included.
    #[inline]
    pub(crate) fn half_diagonal(&self, node: u32) -> f64 {
        self.hulls.half_diagonals[node as usize]
    }

    /// Returns the approximate memory use in bytes.
    pub(crate) fn memory_usage(&self) -> usize {
        self.hulls.pieces.memory_usage()
            + self.hulls.facet_classes.len()
            + 25 * self.hulls.half_diagonals.len()
            + self.hulls.facets_by_point.memory_usage()
    }
}

impl Hulls {
    /// Returns the facets that meet in a point of a node's hull; empty if the hull has no such point.
    fn facets_by_point(&self, node: usize, point: u32) -> &[u32] {
        let points = self.pieces.point_range(node);
        let at = points.start + point as usize;
        if !points.contains(&at) {
            return &[];
        }
        self.facets_by_point.list(at)
    }
}

#[cfg(test)]
mod tests;
