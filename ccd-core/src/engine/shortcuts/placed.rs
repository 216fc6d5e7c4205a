//! Nodes as boxes or triangles in f64, placed where their bodies are at a given clock, and the rate at which two of
//! them approach along a direction.

use crate::body::tree::{NodeId, NodeOrTriangle};
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::gap::Gap;
use crate::motion::path::Path;
use crate::motion::pose::Frame;
use crate::problem::{BodyWithPath, Problem};
use crate::rounding::{BOX_EXTENT_ERROR_F32, RATE_ERROR_F64};
use glam::{DVec3, Vec3};

/// A node's bounding box, or a single triangle, placed where its body is at a given clock.
pub(crate) struct PlacedNode {
    frame: Frame,
    shape: Shape,
    /// The center in the problem's coordinates. All arguments and results are in these coordinates.
    pub(crate) center: DVec3,
    /// An upper bound of the distances of the node's points from the center.
    pub(crate) bounding_radius: f64,
}

enum Shape {
    Box {
        /// The unit axes of the box, in the body's frame.
        axes: [DVec3; 3],
        half_extents: [f64; 3],
        /// The distance by which the node's points may lie outside the box: the radius of rounded pieces, plus the
        /// error of axes and half extents.
        slack: f64,
    },
    /// A triangle, by its corners relative to the center.
    Triangle([DVec3; 3]),
}

impl PlacedNode {
    /// Places the bounding box of a whole body at clock `s`.
    #[inline]
    pub(crate) fn body_box(side: &BodyWithPath<'_>, s: f64) -> Self {
        let frame = side.path.frame(s);
        let whole = &side.body.tree().body_box;
        PlacedNode {
            frame,
            shape: Shape::Box {
                axes: [0, 1, 2].map(|k| whole.axes.col(k)),
                half_extents: whole.half_extents.to_array(),
                slack: whole.slack,
            },
            center: frame.transform_point(whole.center),
            bounding_radius: whole.radius,
        }
    }

    #[inline]
    pub(crate) fn new(side: &BodyWithPath<'_>, id: NodeId, s: f64) -> Self {
        let frame = side.path.frame(s);
        match side.body.tree().get(id) {
            NodeOrTriangle::Node(node) => PlacedNode {
                frame,
                shape: Shape::Box {
                    axes: node.axes.map(Vec3::as_dvec3),
                    half_extents: node.half_extents.map(f64::from),
                    slack: f64::from(node.rounding_radius)
                        + BOX_EXTENT_ERROR_F32 * f64::from(node.radius),
                },
                center: frame.transform_point(node.center),
                bounding_radius: f64::from(node.radius),
            },
            NodeOrTriangle::Triangle(piece) => {
                let corners = side.body.pieces().triangle(piece as usize);
                let [a, b, c] = corners.map(|x| frame.transform_point(x));
                let center = (a + b + c) / 3.0;
                let corners = [a - center, b - center, c - center];
                PlacedNode {
                    frame,
                    shape: Shape::Triangle(corners),
                    center,
                    bounding_radius: corners.map(length).into_iter().fold(0.0, greater),
                }
            }
        }
    }

    /// Returns the corners of a triangle, relative to the center; `None` for a box.
    pub(crate) fn triangle_corners_from_center(&self) -> Option<[DVec3; 3]> {
        match self.shape {
            Shape::Triangle(corners) => Some(corners),
            Shape::Box { .. } => None,
        }
    }

    /// Rotates a vector from the body's frame to the problem's coordinates.
    pub(crate) fn rotate_vector(&self, vector: DVec3) -> DVec3 {
        self.frame.rotation * vector
    }

    /// Returns the point of the box that is nearest to a point, up to rounding; the center of a triangle.
    #[inline]
    pub(crate) fn nearest_point(&self, point: DVec3) -> DVec3 {
        let Shape::Box {
            axes,
            half_extents: half,
            slack,
        } = &self.shape
        else {
            return self.center;
        };
        let way = self.frame.inverse_transform_vector(point - self.center);
        let along = |k: usize| {
            let half = half[k] + slack;
            axes[k] * greater(-half, lesser(half, way.dot(axes[k])))
        };
        self.center + self.rotate_vector(along(0) + along(1) + along(2))
    }

    /// Returns the box axis with the least angle to `n`, in the orientation of `n`; `n` itself for a triangle.
    pub(crate) fn box_axis_nearest_to(&self, n: DVec3) -> DVec3 {
        let Shape::Box { axes, .. } = &self.shape else {
            return n;
        };
        let along = axes.map(|axis| self.rotate_vector(axis));
        let nearest = along
            .into_iter()
            .max_by(|x, y| x.dot(n).abs().total_cmp(&y.dot(n).abs()));
        nearest.map_or(n, |axis| if axis.dot(n) < 0.0 { -axis } else { axis })
    }

    /// Returns `max n·(x − center)` over the node's points `x`, for a vector `n` of any length.
    #[inline]
    pub(crate) fn extent_along(&self, n: DVec3) -> f64 {
        match &self.shape {
            Shape::Triangle(corners) => {
                let [a, b, c] = corners.map(|x| n.dot(x));
                greater(a, greater(b, c))
            }
            Shape::Box {
                axes,
                half_extents: half,
                slack,
            } => {
                let (along, size) = (self.frame.inverse_transform_vector(n), n.length());
                let half = |k: usize| half[k] * along.dot(axes[k]).abs();
                lesser(
                    half(0) + half(1) + half(2) + slack * size,
                    self.bounding_radius * size,
                )
            }
        }
    }
}

/// Upper bounds of the rate at which a node of A and a node of B approach along a direction, and of its derivative.
pub(crate) struct ApproachRateBounds {
    /// The rate at which the nodes' centers approach each other.
    pub(crate) center_approach_rate: f64,
    /// An upper bound of the rate at which any two points of the nodes approach along the direction.
    rate_bound: f64,
    /// An upper bound of the derivative of that rate; negative if the nodes accelerate away from each other.
    second_derivative: f64,
}

impl ApproachRateBounds {
    /// Computes the bounds along a unit vector from A to B, from clock `s` on.
    pub(crate) fn approach_rate_bounds_along_axis(
        problem: &Problem<'_>,
        [a, b]: [&PlacedNode; 2],
        n: DVec3,
        s: f64,
    ) -> Self {
        let straight = center_approach_rate(problem, [a, b], n, s);
        let (mut turning, mut second_derivative, mut speed) = (0.0, 0.0, 0.0);
        for (side, node, n) in [(&problem.a, a, n), (&problem.b, b, -n)] {
            let (path, radius) = (&side.path, node.bounding_radius);
            let arm = node.center - path.center_at(s);
            let across = n.cross(path.spin);
            // n·(ω×w) = w·(n×ω) of points at w from the center.
            turning += greater(0.0, node.extent_along(across))
                + RATE_ERROR_F64 * path.angular_speed * radius;
            let from_axis = length(path.axis.cross(arm)) + radius + RATE_ERROR_F64 * length(arm);
            let across = length(across) + RATE_ERROR_F64 * path.angular_speed;
            second_derivative += across * path.angular_speed * from_axis * (1.0 + RATE_ERROR_F64);
            second_derivative +=
                n.dot(path.acceleration) + RATE_ERROR_F64 * length(path.acceleration);
            speed += path.speed_bound() + path.angular_speed * (length(arm) + radius);
        }
        ApproachRateBounds {
            center_approach_rate: straight,
            rate_bound: straight + turning + 2.0 * RATE_ERROR_F64 * speed,
            second_derivative,
        }
    }

    /// Returns a time in which the nodes certainly approach by less than `gap`.
    pub(crate) fn free_time(&self, gap: f64) -> f64 {
        let gap = Gap {
            gap,
            rate: self.rate_bound,
            second_derivative: self.second_derivative,
        };
        lesser(f64::MAX, gap.free_time())
    }
}

/// Returns the rate at which the nodes' centers approach each other along `n`.
pub(crate) fn center_approach_rate(
    problem: &Problem<'_>,
    [a, b]: [&PlacedNode; 2],
    n: DVec3,
    s: f64,
) -> f64 {
    let rate = |path: &Path, center: DVec3, n: DVec3| n.dot(path.velocity_at(center, s));
    rate(&problem.a.path, a.center, n) + rate(&problem.b.path, b.center, -n)
}

#[cfg(test)]
mod tests;
