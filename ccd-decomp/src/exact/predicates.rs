//! Exact predicates for triangles given by vertex indices, and for projections to a coordinate plane `[SHE97]`. They
//! extend [`ccd_core::exact`].

pub(crate) use ccd_core::exact::{
    first_underflow_prone_point_index, is_degenerate, ray_meets_one_triangle, side_of_line_along,
    side_of_plane,
};

use ccd_core::glam::DVec3;
use ccd_core::limits::MAX_COORDINATE;
use ccd_core::order::greater;
use std::cmp::Ordering;

/// Returns the [side](side_of_plane) of a triangle's plane on which a point lies, exactly. Corners and point are indices into
/// `points`. A corner of the triangle needs no computation, which would be the predicate's slowest.
#[inline]
pub(crate) fn side_of(points: &[DVec3], triangle: [u32; 3], point: u32) -> Ordering {
    if triangle.contains(&point) {
        return Ordering::Equal;
    }
    let [a, b, c] = triangle;
    let corners = [points[a as usize], points[b as usize], points[c as usize]];
    side_of_plane(corners, points[point as usize])
}

/// The projection along a coordinate axis under which a triangle has a non-zero area, with the orientation of its
/// image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Projection {
    /// The coordinate axis along which the triangle is projected.
    axis: usize,
    turned: bool,
}

impl Projection {
    /// Chooses a coordinate axis along which the triangle projects to a non-zero area; `None` if the triangle is
    /// degenerate.
    pub(crate) fn new(triangle: [DVec3; 3]) -> Option<Self> {
        let [a, b, c] = triangle;
        (0..3).find_map(|axis| match side_of_line_along(axis, [a, b], c) {
            Ordering::Equal => None,
            turn => Some(Projection {
                axis,
                turned: turn == Ordering::Less,
            }),
        })
    }

    /// Returns on which side of the line from `a` to `b` a point of the triangle's plane lies. `Greater` is to the
    /// left, seen from the triangle's front.
    #[inline]
    pub(crate) fn turn(self, a: DVec3, b: DVec3, point: DVec3) -> Ordering {
        if self.turned {
            side_of_line_along(self.axis, [b, a], point)
        } else {
            side_of_line_along(self.axis, [a, b], point)
        }
    }
}

/// Returns whether a triangle has zero area; its coordinates may be arbitrarily near to 0. Each axis is first scaled by
/// a power of two until its largest coordinate is about 1, which does not change the answer. Exact, unless coordinates
/// along one axis differ by a factor of more than 1e90.
pub(crate) fn has_zero_area(triangle: [DVec3; 3]) -> bool {
    let [a, b, c] = triangle.map(DVec3::abs);
    let factor = |x: f64| if x < 1.0 { power_of_two_scale(x) } else { 1.0 };
    let scale = DVec3::from_array(a.max(b).max(c).to_array().map(factor));
    is_degenerate(triangle.map(|p| p * scale))
}

/// Returns the power of two that scales a positive number to about 1; 1 for any other number.
fn power_of_two_scale(x: f64) -> f64 {
    const EXPONENT_MASK: u64 = f64::INFINITY.to_bits();
    if x > 0.0 && x.is_finite() {
        greater(
            f64::MIN_POSITIVE,
            f64::from_bits(x.to_bits() & EXPONENT_MASK),
        )
        .recip()
    } else {
        1.0
    }
}

/// Returns the sign of the determinant of the matrix with the given columns. Each column is first scaled by a power of
/// two until its largest element is about 1, which does not change the sign. Exact, unless elements of one column
/// differ by a factor of more than 1e90.
pub(crate) fn determinant_sign(columns: [DVec3; 3]) -> Ordering {
    let [x, y, z] = columns.map(|column| column * power_of_two_scale(column.abs().max_element()));
    side_of_plane([DVec3::ZERO, x, y], z)
}

/// Returns the index of the first point with a coordinate that is not finite or exceeds the supported range.
pub(crate) fn first_point_out_of_range(points: &[DVec3]) -> Option<usize> {
    // Written so that NaN fails.
    let is_good = |p: &DVec3| p.abs().max_element() <= MAX_COORDINATE && p.is_finite();
    points.iter().position(|p| !is_good(p))
}

/// Compares points by x, then y, then z. For points on a line this is their order along the line.
pub(crate) fn compare_lexicographically(p: DVec3, q: DVec3) -> Ordering {
    let by = |x: f64, y: f64| x.partial_cmp(&y).unwrap_or(Ordering::Equal);
    by(p.x, q.x).then(by(p.y, q.y)).then(by(p.z, q.z))
}

#[cfg(test)]
mod tests;
