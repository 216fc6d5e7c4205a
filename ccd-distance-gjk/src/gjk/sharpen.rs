//! Computes separating axes from the features that contain the nearest points. Such axes are more accurate than the
//! difference of the points.

use super::fan::CandidateAxisVertices;
use super::minkowski::MinkowskiDifference;
use super::search::SearchResult;
use super::simplex::{Simplex, Vertex};
use crate::tolerance::MAX_AXIS_VERTICES;
use ccd_core::glam::DVec3;
use ccd_core::vector::unit;

/// Searches for an axis that certifies the distance, among the axes that vertices near the nearest point span.
///
/// Returns the four vertices that are least along the best axis. The nearest point should be a combination of them.
///
/// An axis in the cone of normals at the nearest vertex f has f as its least vertex. Rounding tilts
/// the nearest point's direction out of that cone when the point is short. The axis is therefore
/// made perpendicular to one or two of the edges `x − f` towards vertices x below it, repeatedly,
/// until no vertex is below it.
pub(crate) fn try_feature_axes(
    difference: &MinkowskiDifference<'_>,
    found: &mut SearchResult,
) -> Simplex {
    let Some(mut fan) = CandidateAxisVertices::new(found) else {
        return Simplex::EMPTY;
    };
    if found.axis == DVec3::ZERO {
        // The search found no axis: any axis finds the first vertices.
        let axis = unit(difference.between).unwrap_or(DVec3::X);
        fan.push(found.probe_axis(difference, axis).0);
    }
    for _ in 0..MAX_AXIS_VERTICES {
        let (axis, promise) = fan.best_axis(found.axis);
        // Written so that NaN stops it. The promised gap is at least the gap of the hulls.
        if !(promise > found.gap) {
            break;
        }
        let (vertex, gap) = found.probe_axis(difference, axis);
        if gap >= promise || !fan.push(vertex) {
            break;
        }
    }
    fan.lowest_vertices(found.axis)
}

/// Tries the face normals of a tetrahedron around the origin as axes of least penetration, and stores the best in
/// `found`.
pub(crate) fn try_face_axes(difference: &MinkowskiDifference<'_>, found: &mut SearchResult) {
    let corners = found.simplex.vertices();
    let Ok([a, b, c, d]) = <[Vertex; 4]>::try_from(corners) else {
        return;
    };
    for [a, b, c] in [[a, b, c], [a, b, d], [a, c, d], [b, c, d]] {
        let n = (b.point - a.point).cross(c.point - a.point);
        let inward = if n.dot(a.point) > 0.0 { -n } else { n };
        if let Some(axis) = unit(inward) {
            found.probe_axis(difference, axis);
        }
    }
}
