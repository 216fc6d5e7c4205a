//! The wide tree over a body's pieces: nodes with tight oriented boxes, children in groups of eight
//! laid out for the vector units.

mod build;
mod fit;
mod group;
mod point_query;
mod ray;

pub(crate) use group::{BoxGroup, LANES, Members, TriangleGroup, unit_normal, up};

pub(crate) use point_query::{is_clear, pieces_at};
pub(crate) use ray::crossings;

use super::hierarchy::Hierarchy;
use super::pieces::Pieces;
use crate::error::InputError;
use crate::tolerance::BOX_F64;
use glam::{DVec3, Vec3};

/// An immutable tree in the body's frame. Node 0 is the root; ids beyond the nodes name triangles.
///
/// # Invariants
/// A node's box and ball hold all its pieces, rounding radii included, in exact arithmetic on the
/// stored numbers; every piece is below exactly one child of every group on its way from the root.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    boxes: Vec<BoxGroup>,
    triangles: Vec<TriangleGroup>,
    /// The largest distance of a point from the body's origin, rounding radii included.
    span: f64,
}

/// A node, or a triangle beyond the nodes.
pub(crate) type NodeId = u32;

/// An oriented box, grown by the pieces' rounding, and a ball about the same centre; both hold all
/// pieces below.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) centre: DVec3,
    /// Unit vectors; the last one is the box's thinnest direction.
    pub(crate) axes: [Vec3; 3],
    pub(crate) half: [f32; 3],
    pub(crate) radius: f32,
    /// The largest rounding radius of the pieces below, which the half sizes leave out.
    pub(crate) rounding: f32,
    pub(crate) below: Below,
}

/// What is below a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Below {
    /// A group of nodes.
    Boxes(u32),
    /// A group of triangles.
    Triangles(u32),
    /// A single piece.
    Piece(u32),
}

/// What a [`NodeId`] names.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Named<'a> {
    Node(&'a Node),
    /// A triangle, by the index of its piece.
    Triangle(u32),
}

impl Node {
    /// How far the box reaches along one of its axes, and a little more: the axes are rounded.
    fn reach_f64(&self, axis: usize) -> f64 {
        f64::from(self.half[axis]) + f64::from(self.rounding) + BOX_F64 * f64::from(self.radius)
    }
}

impl Tree {
    /// Builds the tree, and brings the pieces into its order.
    pub(crate) fn build(
        pieces: &Pieces,
        hierarchy: &Hierarchy,
    ) -> Result<(Tree, Pieces), InputError> {
        build::build(pieces, hierarchy)
    }

    #[inline]
    pub(crate) fn get(&self, id: NodeId) -> Named<'_> {
        match self.nodes.get(id as usize) {
            Some(node) => Named::Node(node),
            None => Named::Triangle(id - self.nodes.len() as u32),
        }
    }

    /// The piece that an id names, if it names a single one.
    #[inline]
    pub(crate) fn piece(&self, id: NodeId) -> Option<u32> {
        match self.get(id) {
            Named::Triangle(piece) => Some(piece),
            Named::Node(node) => match node.below {
                Below::Piece(piece) => Some(piece),
                _ => None,
            },
        }
    }

    pub(crate) fn box_group(&self, index: u32) -> &BoxGroup {
        &self.boxes[index as usize]
    }

    pub(crate) fn triangle_group(&self, index: u32) -> &TriangleGroup {
        &self.triangles[index as usize]
    }

    /// The largest distance of a point from the body's origin.
    pub(crate) fn span(&self) -> f64 {
        self.span
    }

    /// The radius of the root's ball.
    pub(crate) fn radius(&self) -> f32 {
        self.nodes[0].radius
    }

    /// The half sizes of the root's box.
    pub(crate) fn half(&self) -> [f32; 3] {
        self.nodes[0].half
    }

    /// Whether a point is within the root's box, or near it.
    pub(crate) fn may_contain(&self, point: DVec3) -> bool {
        point_query::holds(&self.nodes[0], point, 0.0)
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
            + size_of_val(self.boxes.as_slice())
            + size_of_val(self.triangles.as_slice())
    }
}

#[cfg(test)]
mod tests;
