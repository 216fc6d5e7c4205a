//! The bounding volume tree over a body's pieces: oriented boxes, with children in groups of eight.

mod build;
mod fit;
mod group;
pub(crate) mod point_query;
pub(crate) mod ray;
mod slab;
mod waiting;
mod whole;

pub(crate) use build::TreeLayout;
pub(crate) use group::{
    BoxGroup, GroupHeader, LANES, Node, NodeChildren, StoredTriangleGroup, TriangleGroup,
    is_thin_triangle, round_up_to_f32, unit_normal,
};
pub(crate) use slab::Slab;
pub(crate) use whole::BodyBox;

use super::pieces::Pieces;
use fearless_simd::Simd;
use glam::DVec3;

/// A bounding volume tree in the body's frame, with up to eight children per node. Node 0 is the root. Ids after those
/// of the nodes are triangles.
///
/// # Invariants
/// A node's box and ball contain all its pieces, rounding radii included, in exact arithmetic on
/// the stored numbers. Every piece is below exactly one child of every group on its path from the
/// root.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    box_groups: Vec<BoxGroup>,
    triangle_groups: Vec<StoredTriangleGroup>,
    /// The slabs around flat nodes, sorted by node.
    slabs: Vec<(NodeId, Slab)>,
    /// The bounding box of the whole body, which is tighter than the root's box in f32.
    pub(crate) body_box: BodyBox,
    /// The largest distance of a piece's points from the body's origin, plus the rounding radius.
    pub(crate) max_distance_from_origin: f64,
}

/// The id of a node or a triangle: ids below the number of nodes are nodes, higher ids are triangles.
pub(crate) type NodeId = u32;

/// The node or triangle that a [`NodeId`] refers to.
#[derive(Clone, Copy, Debug)]
pub(crate) enum NodeOrTriangle<'a> {
    Node(&'a Node),
    /// A triangle, by the index of its piece.
    Triangle(u32),
}

impl Tree {
    #[inline(always)]
    pub(crate) fn get(&self, id: NodeId) -> NodeOrTriangle<'_> {
        match self.nodes.get(id as usize) {
            Some(node) => NodeOrTriangle::Node(node),
            None => NodeOrTriangle::Triangle(id - self.nodes.len() as u32),
        }
    }

    /// Returns the number of nodes, triangles not included.
    pub(crate) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Returns the index of the piece if the id refers to a single piece or triangle; `None` for other nodes.
    #[inline]
    pub(crate) fn piece(&self, id: NodeId) -> Option<u32> {
        match self.get(id) {
            NodeOrTriangle::Triangle(piece) => Some(piece),
            NodeOrTriangle::Node(node) => match node.children {
                NodeChildren::Piece(piece) => Some(piece),
                _ => None,
            },
        }
    }

    pub(crate) fn box_group(&self, index: u32) -> &BoxGroup {
        &self.box_groups[index as usize]
    }

    /// Returns the slab around a flat node; `None` for other nodes.
    pub(crate) fn flat_node_slab(&self, id: NodeId) -> Option<&Slab> {
        let place = self.slabs.binary_search_by_key(&id, |&(id, _)| id).ok()?;
        Some(&self.slabs[place].1)
    }

    /// Creates the group of triangles with this index, in the layout for vector instructions.
    #[inline(always)]
    pub(crate) fn triangle_group<L: Simd>(
        &self,
        level: L,
        index: u32,
        pieces: &Pieces,
    ) -> TriangleGroup {
        let row = &self.triangle_groups[index as usize];
        let first = row.header.first_child as usize - self.nodes.len();
        let triangles = pieces.points_of(first..first + row.header.count as usize);
        TriangleGroup::new(level, row, triangles.as_chunks().0)
    }

    /// Returns the origin, the reach and the children's ids of a group of triangles.
    pub(crate) fn triangle_group_header(&self, index: u32) -> &GroupHeader {
        &self.triangle_groups[index as usize].header
    }

    /// Returns the center and radius of a ball around all pieces, in the body's frame.
    pub(crate) fn bounding_ball(&self) -> (DVec3, f64) {
        (self.nodes[0].center, f64::from(self.nodes[0].radius))
    }

    /// Returns an upper bound of the distances of all points of the body from a point, by the ball around all pieces.
    pub(crate) fn max_distance_from(&self, point: DVec3) -> f64 {
        let (center, radius) = self.bounding_ball();
        center.distance(point) * (1.0 + f64::EPSILON) + radius
    }

    /// Returns the radius of the ball around all pieces.
    pub(crate) fn radius(&self) -> f32 {
        self.nodes[0].radius
    }

    /// Returns the half extents of the root's box.
    pub(crate) fn half_extents(&self) -> [f32; 3] {
        self.nodes[0].half_extents
    }

    /// Returns whether a point may be in the body: it is in the root's box up to rounding.
    pub(crate) fn may_contain(&self, point: DVec3) -> bool {
        self.nodes[0].is_near(point, 0.0)
    }

    pub(crate) fn memory_usage(&self) -> usize {
        size_of_val(self.nodes.as_slice())
            + size_of_val(self.box_groups.as_slice())
            + size_of_val(self.triangle_groups.as_slice())
            + size_of_val(self.slabs.as_slice())
    }
}

#[cfg(test)]
mod tests;
