//! Boxes with rounded edges around convex parts.

use super::HullPart;
use ccd_core::order::{greater, lesser};
use rigid_ccd::glam::{DMat3, DVec3};

/// The largest distance of a corner of a part from the corner of its box, as a fraction of the largest coordinate, for
/// which the part counts as the box.
const CORNER_TOLERANCE: f64 = 1e-12;

/// A box with rounded edges (Minkowski sum with a ball) that contains a part, in the frame of the part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RoundedBox {
    pub(crate) center: DVec3,
    /// The axes of the box as columns.
    pub(crate) axes: DMat3,
    pub(crate) half_extents: DVec3,
    /// The radius of the ball.
    pub(crate) radius: f64,
    /// Whether the part is the rounded box, up to [`CORNER_TOLERANCE`]: a box, a rectangle, a capsule or a ball.
    pub(crate) is_exact: bool,
}

impl HullPart {
    /// Returns the rounded box around the part along the axes of its body, or along the segment between two corners.
    pub(crate) fn rounded_box(&self) -> RoundedBox {
        let axes = match self.points[..] {
            [one, other] => axes_with_first((other - one).normalize_or(DVec3::X)),
            _ => self.rotation,
        };
        let to_axes = axes.transpose();
        let along_axes: Vec<DVec3> = self.points.iter().map(|&point| to_axes * point).collect();
        let (mut min, mut max) = (along_axes[0], along_axes[0]);
        for &point in &along_axes {
            (min, max) = (min.min(point), max.max(point));
        }
        let (middle, half_extents) = (0.5 * (min + max), 0.5 * (max - min));
        let tolerance = CORNER_TOLERANCE * self.coordinate_bound;
        let is_corner = |&point: &DVec3| {
            let beyond = (point - middle).abs() - half_extents;
            beyond.abs().max_element() <= tolerance
        };
        let extended = half_extents.to_array().map(|extent| extent > tolerance);
        let corner_count = 1 << extended.iter().filter(|&&extends| extends).count();
        RoundedBox {
            center: axes * middle,
            axes,
            half_extents: half_extents + DVec3::splat(tolerance),
            radius: self.radius,
            // Two points at the same corner are less than √(1 + 1 + 4) tolerances apart.
            is_exact: self.is_convex
                && self.points.len() == corner_count
                && along_axes.iter().all(is_corner)
                && are_distinct(&along_axes, 4.0 * tolerance),
        }
    }
}

/// Returns three axes at right angles, the given unit vector first.
fn axes_with_first(axis: DVec3) -> DMat3 {
    let second = axis.any_orthonormal_vector();
    DMat3::from_cols(axis, second, axis.cross(second))
}

/// Returns whether any two points are farther apart than a distance.
fn are_distinct(points: &[DVec3], distance: f64) -> bool {
    let mut nearest = f64::INFINITY;
    for (k, point) in points.iter().enumerate() {
        let distances = points[..k].iter().map(|other| point.distance(*other));
        nearest = distances.fold(nearest, lesser);
    }
    nearest > greater(distance, 0.0) || points.len() == 1
}
