//! Bounding boxes of single nodes, and triangles, in f64 at the pose of a clock.

use crate::body::tree::{NodeId, NodeOrTriangle};
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::pose::Frame;
use crate::problem::Side;
use crate::rounding::BOX_AXES_F32;
use glam::{DVec3, Vec3};

/// A node's box or a triangle at the pose of a clock.
pub(crate) struct Placed {
    frame: Frame,
    shape: Shape,
    /// The centre in the problem's coordinates, in which all arguments and results are.
    pub(crate) centre: DVec3,
    /// An upper bound of the distances of the node's points from the centre.
    pub(crate) radius: f64,
}

enum Shape {
    Box {
        /// The axes of the box at that pose.
        axes: [DVec3; 3],
        half: [f64; 3],
        /// The pieces' rounding radius, plus the error of the axes and half extents.
        slack: f64,
    },
    /// A triangle, by its corners relative to the centre.
    Triangle([DVec3; 3]),
}

impl Placed {
    /// Places the bounding box of a whole body at clock `s`.
    #[inline]
    pub(crate) fn body_box(side: &Side<'_>, s: f64) -> Self {
        let frame = side.path.frame(s);
        let whole = side.body.tree().body_box();
        Placed {
            frame,
            shape: Shape::Box {
                axes: [0, 1, 2].map(|k| whole.axes.col(k)),
                half: whole.half.to_array(),
                slack: whole.slack,
            },
            centre: frame.point(whole.centre),
            radius: whole.radius,
        }
    }

    #[inline]
    pub(crate) fn new(side: &Side<'_>, id: NodeId, s: f64) -> Self {
        let frame = side.path.frame(s);
        match side.body.tree().get(id) {
            NodeOrTriangle::Node(node) => Placed {
                frame,
                shape: Shape::Box {
                    axes: node.axes.map(Vec3::as_dvec3),
                    half: node.half.map(f64::from),
                    slack: f64::from(node.rounding) + BOX_AXES_F32 * f64::from(node.radius),
                },
                centre: frame.point(node.centre),
                radius: f64::from(node.radius),
            },
            NodeOrTriangle::Triangle(piece) => {
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

    /// Returns the corners of a triangle, relative to the centre; `None` for a box.
    pub(crate) fn corners(&self) -> Option<[DVec3; 3]> {
        match self.shape {
            Shape::Triangle(corners) => Some(corners),
            Shape::Box { .. } => None,
        }
    }

    /// Rotates a vector from the body's frame.
    pub(crate) fn rotated(&self, vector: DVec3) -> DVec3 {
        self.frame.rotation * vector
    }

    /// Returns the point of the box that is nearest to a point, up to rounding; the centre of a triangle.
    #[inline]
    pub(crate) fn project(&self, point: DVec3) -> DVec3 {
        let Shape::Box { axes, half, slack } = &self.shape else {
            return self.centre;
        };
        let way = self.frame.inverse_vector(point - self.centre);
        let along = |k: usize| {
            let half = half[k] + slack;
            axes[k] * greater(-half, lesser(half, way.dot(axes[k])))
        };
        self.centre + self.rotated(along(0) + along(1) + along(2))
    }

    /// Returns the axis of the box that is nearest in direction to `n`, oriented like it; `n` itself for a triangle.
    pub(crate) fn axis_along(&self, n: DVec3) -> DVec3 {
        let Shape::Box { axes, .. } = &self.shape else {
            return n;
        };
        let along = axes.map(|axis| self.rotated(axis));
        let nearest = along
            .into_iter()
            .max_by(|x, y| x.dot(n).abs().total_cmp(&y.dot(n).abs()));
        nearest.map_or(n, |axis| if axis.dot(n) < 0.0 { -axis } else { axis })
    }

    /// Returns `max n·(x − centre)` over the node's points `x`, for a vector `n` of any length.
    #[inline]
    pub(crate) fn extent_along(&self, n: DVec3) -> f64 {
        match &self.shape {
            Shape::Triangle(corners) => {
                let [a, b, c] = corners.map(|x| n.dot(x));
                greater(a, greater(b, c))
            }
            Shape::Box { axes, half, slack } => {
                let (along, size) = (self.frame.inverse_vector(n), n.length());
                let half = |k: usize| half[k] * along.dot(axes[k]).abs();
                lesser(
                    half(0) + half(1) + half(2) + slack * size,
                    self.radius * size,
                )
            }
        }
    }
}

#[cfg(test)]
mod tests;
