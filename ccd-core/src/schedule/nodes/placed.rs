//! Single nodes and triangles in f64, for looks closer than the eight bounds in f32.

use crate::body::tree::{Named, Node, NodeId};
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::pose::Frame;
use crate::problem::Side;
use crate::tolerance::BOX_AXES_F32;
use glam::DVec3;

/// A node or a triangle where its body is.
pub(super) struct Placed<'p> {
    frame: Frame,
    shape: Shape<'p>,
    /// In the problem's coordinates, as everything that is handed in or out.
    pub(super) centre: DVec3,
    /// An upper bound of the points' distances from the centre.
    pub(super) radius: f64,
}

enum Shape<'p> {
    Box(&'p Node),
    /// The corners, relative to the centre.
    Triangle([DVec3; 3]),
}

impl<'p> Placed<'p> {
    #[inline]
    pub(super) fn new(side: &Side<'p>, id: NodeId, s: f64) -> Self {
        let frame = side.path.frame(s);
        match side.body.tree().get(id) {
            Named::Node(node) => Placed {
                frame,
                shape: Shape::Box(node),
                centre: frame.point(node.centre),
                radius: f64::from(node.radius),
            },
            Named::Triangle(piece) => {
                let corners = side.body.pieces().triangle(piece as usize);
                let [a, b, c] = corners.map(|x| frame.point(x));
                let centre = (a + b + c) / 3.0;
                let corners = [a - centre, b - centre, c - centre];
                Placed {
                    frame,
                    shape: Shape::Triangle(corners),
                    centre,
                    radius: corners.map(length).into_iter().fold(0.0, greater),
                }
            }
        }
    }

    /// Turns a vector along with the body.
    pub(super) fn turned(&self, vector: DVec3) -> DVec3 {
        self.frame.rotation * vector
    }

    /// Returns the nearest point of the box, up to rounding; the centre of a triangle.
    #[inline]
    pub(super) fn project(&self, point: DVec3) -> DVec3 {
        let Shape::Box(node) = &self.shape else {
            return self.centre;
        };
        let way = self.frame.inverse_vector(point - self.centre);
        let along = |k: usize| {
            let half = f64::from(node.half[k]) + f64::from(node.rounding);
            axis(node, k) * greater(-half, lesser(half, way.dot(axis(node, k))))
        };
        self.centre + self.turned(along(0) + along(1) + along(2))
    }

    /// Returns `max n·(x − centre)` over the points, for an axis of any length.
    #[inline]
    pub(super) fn reach(&self, n: DVec3) -> f64 {
        match &self.shape {
            Shape::Triangle(corners) => {
                let [a, b, c] = corners.map(|x| n.dot(x));
                greater(a, greater(b, c))
            }
            Shape::Box(node) => {
                let (along, size) = (self.frame.inverse_vector(n), n.length());
                let half = |k: usize| f64::from(node.half[k]) * along.dot(axis(node, k)).abs();
                let rounding = f64::from(node.rounding) + BOX_AXES_F32 * self.radius;
                lesser(
                    half(0) + half(1) + half(2) + rounding * size,
                    self.radius * size,
                )
            }
        }
    }
}

fn axis(node: &Node, k: usize) -> DVec3 {
    node.axes[k].as_dvec3()
}

#[cfg(test)]
mod tests;
