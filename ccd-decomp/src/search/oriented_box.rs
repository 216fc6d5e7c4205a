//! Oriented boxes, and the tests that separate them from points and shapes.

use super::element::Element;
use crate::tolerance::box_rounding_bound;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::rounding::UNIT_ROUNDOFF_F64;
use ccd_core::vector::unit;

/// An oriented box: its center, half lengths along its axes, and a slack along the coordinate axes. The slack covers
/// rounding, and axes that are not exactly orthonormal.
pub(super) struct OrientedBox {
    pub(super) center: DVec3,
    pub(super) axes: [DVec3; 3],
    pub(super) half_lengths: DVec3,
    pub(super) slack: f64,
    /// An upper bound of the absolute coordinates of all points of the box.
    pub(super) max_abs_coordinate: f64,
}

impl OrientedBox {
    /// Creates a box around some elements. It is aligned with their longest side and the corner farthest from that
    /// side.
    pub(super) fn enclosing_elements(elements: &[Element]) -> Self {
        let corners = || elements.iter().flat_map(|element| element.corners);
        let center = corners().sum::<DVec3>() / (3 * elements.len()) as f64;
        let longer = |a: &DVec3, b: &DVec3| a.length_squared().total_cmp(&b.length_squared());
        let sides = |element: &Element| {
            let [a, b, c] = element.corners;
            [b - a, c - b, a - c]
        };
        let longest = elements.iter().flat_map(sides).max_by(longer);
        let first = longest.and_then(unit).unwrap_or(DVec3::X);
        let aside = |p: DVec3| (p - center).reject_from_normalized(first);
        let farthest = corners().map(aside).max_by(longer);
        let second = farthest.and_then(unit);
        let second = second.unwrap_or_else(|| first.any_orthonormal_vector());
        let axes = [first, second, first.cross(second)];
        let (mut halves, mut slack, mut reach) = (DVec3::ZERO, 0.0, 0.0);
        for p in corners() {
            let offset = p - center;
            let along = dot_with_axes(&axes, offset);
            let rest = offset - along.x * first - along.y * second - along.z * axes[2];
            halves = halves.max(along.abs());
            slack = greater(slack, rest.abs().max_element());
            reach = greater(reach, p.abs().max_element());
        }
        // The difference and the three products above round by less than 16 units of the reach.
        let slack = slack + 64.0 * UNIT_ROUNDOFF_F64 * reach;
        OrientedBox {
            center,
            axes,
            half_lengths: halves,
            slack,
            max_abs_coordinate: center.abs().max_element() + halves.element_sum() + slack,
        }
    }

    /// Returns the axis of the box along which the centers of some elements spread most. For the teeth of a comb this
    /// is not the longest axis.
    pub(super) fn axis_of_largest_spread(&self, elements: &[Element]) -> DVec3 {
        let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for element in elements {
            let offset = element.center() - self.center;
            let along = dot_with_axes(&self.axes, offset);
            (lo, hi) = (lo.min(along), hi.max(along));
        }
        self.axes[(hi - lo).max_position()]
    }

    /// Returns an upper bound of the dot product of a vector with the offset of any point of the box from the center.
    #[inline]
    pub(super) fn support_bound(&self, vector: DVec3) -> f64 {
        let along = dot_with_axes(&self.axes, vector).abs();
        along.dot(self.half_lengths) + vector.abs().element_sum() * self.slack
    }

    /// Returns a lower bound, up to rounding, of the distance of a point from the box; negative inside. Each axis is
    /// tested separately, because they need not be orthogonal.
    pub(super) fn least_distance(&self, point: DVec3) -> f64 {
        let along = dot_with_axes(&self.axes, point - self.center).abs();
        (along - self.half_lengths).max_element() - 2.0 * self.slack
    }

    /// Returns whether an axis of the box certainly separates the box from all given points.
    pub(super) fn is_separated_from_points(&self, points: &[DVec3]) -> bool {
        let reach = points.iter().map(|p| p.abs().max_element());
        let reach = reach.fold(self.max_abs_coordinate, greater);
        (0..3).any(|k| {
            let axis = self.axes[k];
            let least = self.half_lengths[k] + self.slack + box_rounding_bound(axis, reach);
            let along = |&p: &DVec3| axis.dot(p - self.center);
            // Written so that NaN does not separate.
            points.iter().all(|p| along(p) > least) || points.iter().all(|p| along(p) < -least)
        })
    }
}

/// Returns the dot products of a vector with three axes.
#[inline]
fn dot_with_axes(axes: &[DVec3; 3], offset: DVec3) -> DVec3 {
    DVec3::new(
        axes[0].dot(offset),
        axes[1].dot(offset),
        axes[2].dot(offset),
    )
}

#[cfg(test)]
mod tests;
