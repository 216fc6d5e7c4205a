//! The bounding box of a whole body, in f64.

use super::fit::{NodePoints, PointSample, best_frame};
use crate::math::order::greater;
use crate::math::vector::{bounding_box, componentwise_max, length};
use crate::rounding::UNIT_ROUNDOFF_F64;
use glam::{DMat3, DVec3};

/// The oriented bounding box of a whole body, computed in f64. The root's own box is rounded to f32: with it, bodies
/// that slide along each other closer than that would count as near each other everywhere.
///
/// # Guarantee
/// For a unit vector n, no point of the body is farther along n from the center than the sum of `half` times the
/// components of n along the axes, and `slack`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyBox {
    pub(crate) center: DVec3,
    /// The axes of the box as columns; `slack` covers their error.
    pub(crate) axes: DMat3,
    pub(crate) half_extents: DVec3,
    /// An upper bound of the distances of the pieces' points from the center.
    pub(crate) radius: f64,
    /// The pieces' rounding radius, plus a bound of the errors of the axes and half extents.
    pub(crate) slack: f64,
}

impl BodyBox {
    /// Fits the box to all points of a body, in the best frame that a sample of the points gives.
    pub(super) fn fit_to(node_points: &NodePoints<'_>, sample: &mut PointSample) -> Self {
        sample.fill_from(node_points);
        let axes = best_frame(sample, node_points.are_triangles);
        let turned = axes.transpose();
        let (low, high) = bounding_box(node_points.points.iter().map(|&p| turned * p));
        let center = axes * (0.5 * (low + high));
        let (mut half, mut radius) = (DVec3::ZERO, 0.0);
        for &point in node_points.points {
            let way = point - center;
            let along = (turned * way).abs();
            half = componentwise_max(half, along);
            radius = greater(radius, length(way));
        }
        // A point's components along the axes add up to the point, except for the deviation of the axes from an
        // orthonormal frame: three times the largest entry. Differences, products and sums of components are off by
        // 8u of the radius each.
        let off = turned * axes - DMat3::IDENTITY;
        let largest = off
            .to_cols_array()
            .into_iter()
            .fold(0.0, |sum, entry| greater(sum, entry.abs()));
        BodyBox {
            center,
            axes,
            half_extents: half,
            radius: (radius + node_points.rounding_radius) * (1.0 + 8.0 * UNIT_ROUNDOFF_F64),
            slack: node_points.rounding_radius
                + (3.0 * largest + 32.0 * UNIT_ROUNDOFF_F64) * radius,
        }
    }
}

#[cfg(test)]
mod tests;
