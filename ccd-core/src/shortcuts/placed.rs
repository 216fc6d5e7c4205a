//! Single nodes and triangles in f64, for bounds tighter than the eight in f32.

use crate::body::tree::{Named, NodeId};
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::pose::Frame;
use crate::problem::Side;
use crate::rounding::BOX_AXES_F32;
use glam::{DVec3, Vec3};

/// A node or a triangle at its body's position.
pub(crate) struct Placed {
    frame: Frame,
    shape: Shape,
    /// The centre, in the problem's coordinates. All arguments and results are in these coordinates.
    pub(crate) centre: DVec3,
    /// An upper bound of the points' distances from the centre.
    pub(crate) radius: f64,
}

enum Shape {
    Box {
        /// The axes of the box, which are those of the body.
        axes: [DVec3; 3],
        half: [f64; 3],
        /// The pieces' rounding radius, and the error of axes and half sizes.
        slack: f64,
    },
    /// The corners, relative to the centre.
    Triangle([DVec3; 3]),
}

impl Placed {
    /// Places the box about a whole body.
    #[inline]
    pub(crate) fn whole(side: &Side<'_>, s: f64) -> Self {
        let frame = side.path.frame(s);
        let whole = side.body.tree().whole();
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
            Named::Node(node) => Placed {
                frame,
                shape: Shape::Box {
                    axes: node.axes.map(Vec3::as_dvec3),
                    half: node.half.map(f64::from),
                    slack: f64::from(node.rounding) + BOX_AXES_F32 * f64::from(node.radius),
                },
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

    /// Returns the corners of a triangle, relative to the centre; `None` for a box.
    pub(crate) fn corners(&self) -> Option<[DVec3; 3]> {
        match self.shape {
            Shape::Triangle(corners) => Some(corners),
            Shape::Box { .. } => None,
        }
    }

    /// Rotates a vector with the body.
    pub(crate) fn turned(&self, vector: DVec3) -> DVec3 {
        self.frame.rotation * vector
    }

    /// Returns the nearest point of the box, up to rounding; the centre of a triangle.
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
        self.centre + self.turned(along(0) + along(1) + along(2))
    }

    /// Returns the axis of the box that is nearest to a vector, with the sign of the vector; the vector itself for a
    /// triangle.
    pub(crate) fn axis_along(&self, n: DVec3) -> DVec3 {
        let Shape::Box { axes, .. } = &self.shape else {
            return n;
        };
        let along = axes.map(|axis| self.turned(axis));
        let nearest = along
            .into_iter()
            .max_by(|x, y| x.dot(n).abs().total_cmp(&y.dot(n).abs()));
        nearest.map_or(n, |axis| if axis.dot(n) < 0.0 { -axis } else { axis })
    }

    /// Returns `max n·(x − centre)` over the points, for an axis of any length.
    #[inline]
    pub(crate) fn reach(&self, n: DVec3) -> f64 {
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
