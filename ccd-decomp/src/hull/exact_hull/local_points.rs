//! Exact tests of the side of a plane on which a point lies, with a fast floating-point filter.

use crate::exact::predicates::side_of;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::rounding::height_rounding;
use std::cmp::Ordering;

/// A list of points, and their positions relative to the first one.
pub(super) struct LocalPoints<'a> {
    input_points: &'a [DVec3],
    relative_positions: Vec<DVec3>,
    /// The largest absolute coordinate of a relative position.
    max_abs_coordinate: f64,
}

/// The plane through three of the points, with rounded coefficients.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    normal: DVec3,
    plane_offset: f64,
    /// A bound on the rounding error of the computed height of any of the points above the plane.
    rounding: f64,
}

impl<'a> LocalPoints<'a> {
    pub(super) fn new(points: &'a [DVec3]) -> Self {
        let base = points.first().copied().unwrap_or(DVec3::ZERO);
        let relative: Vec<DVec3> = points.iter().map(|&p| p - base).collect();
        let coordinates = relative.iter().map(|p| p.abs().max_element());
        LocalPoints {
            input_points: points,
            max_abs_coordinate: coordinates.fold(0.0, greater),
            relative_positions: relative,
        }
    }

    pub(super) fn plane(&self, corners: [u32; 3]) -> Plane {
        let [p, q, r] = corners.map(|v| self.input_points[v as usize]);
        let sides = [q - p, r - p];
        let normal = sides[0].cross(sides[1]);
        Plane {
            normal,
            plane_offset: normal.dot(self.relative_positions[corners[0] as usize]),
            rounding: height_rounding(sides, self.max_abs_coordinate),
        }
    }

    /// Returns whether a point is in front of the plane through three corners; the result is exact.
    #[inline]
    pub(super) fn is_in_front(&self, plane: &Plane, corners: [u32; 3], v: u32) -> bool {
        let height = plane.normal.dot(self.relative_positions[v as usize]) - plane.plane_offset;
        // Written so that NaN is decided exactly.
        if height.abs() > plane.rounding {
            height > 0.0
        } else {
            side_of(self.input_points, corners, v) == Ordering::Greater
        }
    }
}

#[cfg(test)]
mod tests;
