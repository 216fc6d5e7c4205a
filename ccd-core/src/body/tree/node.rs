//! Nodes of the wide tree: an oriented box, a ball, and the children.

use crate::rounding::{BOX_F64, THIN_F32, U64};
use glam::{DVec3, Vec3};

/// An oriented box and a ball with the same centre, which both contain all pieces below, and the children.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) centre: DVec3,
    /// The axes of the box as unit vectors, the direction of the least extent last.
    pub(crate) axes: [Vec3; 3],
    pub(crate) half: [f32; 3],
    pub(crate) radius: f32,
    /// The largest rounding radius of the pieces below, which the half sizes do not include.
    pub(crate) rounding: f32,
    pub(crate) below: Below,
}

/// The children of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Below {
    /// A group of nodes, by its index.
    Boxes(u32),
    /// A group of triangles, by its index.
    Triangles(u32),
    /// A single piece, by its index.
    Piece(u32),
}

impl Node {
    /// A placeholder for a node that is not fitted yet.
    pub(super) const UNFITTED: Node = Node {
        centre: DVec3::ZERO,
        axes: [Vec3::ZERO; 3],
        half: [0.0; 3],
        radius: 0.0,
        rounding: 0.0,
        below: Below::Piece(0),
    };

    /// Returns whether the box is thin enough for the node to count as flat.
    pub(crate) fn is_thin(&self) -> bool {
        self.half[2] <= THIN_F32 * self.radius
    }

    /// Returns half the extent of the box along one of its axes, widened because the axes are rounded.
    pub(super) fn half_extent(&self, axis: usize) -> f64 {
        f64::from(self.half[axis]) + f64::from(self.rounding) + BOX_F64 * f64::from(self.radius)
    }

    /// Returns whether a point is in the box, or within about `reach` of it.
    pub(super) fn is_near(&self, point: DVec3, reach: f64) -> bool {
        let way = point - self.centre;
        let reach = reach + 8.0 * U64 * way.abs().element_sum();
        (0..3)
            .all(|k| way.dot(self.axes[k].as_dvec3()).abs() <= self.half_extent(k) + 1.001 * reach)
    }
}
