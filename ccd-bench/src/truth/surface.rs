//! The triangles of a mesh in a tree of boxes along the axes of the body's frame.

use super::rounding::{ROUND_UP_FACTOR, nan_propagating_max};
use ccd_core::glam::DVec3;
use ccd_decomp::TriangleMesh;

/// The triangles of a mesh with a tree of boxes over them, as input of the referee.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The nodes of the tree, the root first, and children after their parents.
    nodes: Vec<Node>,
    triangles: Vec<Triangle>,
}

/// The three corners of a triangle, in the body's frame.
pub(super) type Triangle = [DVec3; 3];

/// A node of the tree: a box around some triangles, with its two children or its single triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) box_center: DVec3,
    /// Half the extents of the box, rounded so that it contains all its triangles.
    pub(super) half_extents: DVec3,
    /// Half the diagonal of the box.
    pub(super) half_diagonal: f64,
    pub(super) content: NodeContent,
}

/// The contents of a node: two child nodes, or one triangle.
#[derive(Clone, Copy, Debug)]
pub(super) enum NodeContent {
    /// The box of an inner node contains the boxes of these two nodes.
    Children([u32; 2]),
    /// The box of a leaf contains the triangle with this index.
    Triangle(u32),
}

impl Surface {
    /// Builds the tree of boxes over a mesh.
    ///
    /// # Complexity
    /// O(n log n) for n triangles.
    pub fn new(mesh: &TriangleMesh) -> Self {
        let corner = |&index: &u32| mesh.vertices().get(index as usize).copied();
        let triangles = mesh.faces().iter().map(|face| {
            // The faces of a mesh refer to existing vertices.
            face.each_ref().map(|i| corner(i).unwrap_or_default())
        });
        let mut surface = Surface {
            nodes: Vec::with_capacity(2 * mesh.faces().len()),
            triangles: triangles.collect(),
        };
        let mut order: Vec<u32> = (0..).take(surface.triangles.len()).collect();
        if !order.is_empty() {
            surface.add_subtree(&mut order);
        }
        surface
    }

    /// Returns the index of the root; `None` without triangles.
    pub(super) fn root(&self) -> Option<u32> {
        (!self.nodes.is_empty()).then_some(0)
    }

    pub(super) fn node(&self, index: u32) -> &Node {
        &self.nodes[index as usize]
    }

    pub(super) fn triangle(&self, index: u32) -> &Triangle {
        &self.triangles[index as usize]
    }

    /// Returns the corners of the box around the whole body; none for a body without triangles.
    pub(super) fn box_corners(&self) -> impl Iterator<Item = DVec3> {
        let root = self
            .nodes
            .first()
            .map(|node| (node.box_center, node.half_extents));
        root.into_iter().flat_map(|(center, half)| {
            (0..8).map(move |corner| {
                let side = |bit| if corner & bit == 0 { -1.0 } else { 1.0 };
                center + half * DVec3::new(side(1), side(2), side(4))
            })
        })
    }

    /// Returns an upper bound of the distance of the body's points from the origin.
    pub(super) fn max_distance_from_origin(&self) -> f64 {
        let far = self
            .box_corners()
            .map(DVec3::length)
            .fold(0.0, nan_propagating_max);
        far * ROUND_UP_FACTOR
    }

    /// Adds the subtree over some triangles, and returns the index of its root. The triangles are halved at the median
    /// along their longest extent, so the depth is the logarithm of their number.
    fn add_subtree(&mut self, order: &mut [u32]) -> u32 {
        let index = self.nodes.len();
        let node = self.bounding_node(order);
        self.nodes.push(node);
        if let [triangle] = order {
            self.nodes[index].content = NodeContent::Triangle(*triangle);
        } else {
            let middle = order.len() / 2;
            let axis = node.half_extents.max_position();
            let key = |&i: &u32| self.triangle(i).iter().map(|p| p[axis]).sum::<f64>();
            order.select_nth_unstable_by(middle, |i, j| key(i).total_cmp(&key(j)));
            let (left, right) = order.split_at_mut(middle);
            let children = [self.add_subtree(left), self.add_subtree(right)];
            self.nodes[index].content = NodeContent::Children(children);
        }
        index as u32
    }

    fn bounding_node(&self, order: &[u32]) -> Node {
        let corners = order.iter().flat_map(|&i| self.triangle(i));
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &corner in corners {
            low = low.min(corner);
            high = high.max(corner);
        }
        let center = low.midpoint(high);
        let half = (high - center).max(center - low) * ROUND_UP_FACTOR;
        Node {
            box_center: center,
            half_extents: half,
            half_diagonal: half.length(),
            content: NodeContent::Triangle(0),
        }
    }
}
