//! The point of a segment that is nearest to the origin.

use super::foot::NearestPoint;
use ccd_core::glam::DVec3;

/// Returns the point nearest to the origin on the segment from `a` to `b`; the two ends may be equal.
pub(crate) fn nearest_point(a: DVec3, b: DVec3) -> NearestPoint {
    let d = b - a;
    let (along, square) = (-a.dot(d), d.length_squared());
    // Written so that NaN, and a segment without a length, end at a corner.
    if along >= square && square > 0.0 {
        return NearestPoint::at_vertex(b, 1);
    }
    if !(along > 0.0 && square > 0.0) {
        return NearestPoint::at_vertex(a, 0);
    }
    let t = along / square;
    let point = a + d * t;
    NearestPoint {
        weights: [1.0 - t, t, 0.0, 0.0],
        point,
        // Made perpendicular again, to correct the rounding of a short difference.
        direction: Some(point - d * (point.dot(d) / square)),
    }
}
