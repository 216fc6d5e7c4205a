//! Bounds the excess of the hull of a nearly convex solid by a shrunk copy of the hull within the solid.

use super::enclosed_mesh::EnclosedMesh;
use super::facet_planes::Plane;
use crate::tolerance::{EXCESS_WORK_BUDGET, PLANE_TESTS_PER_STEP};
use ccd_core::Hull;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// Returns an upper bound on the distance from a solid to any point of its hull; `None` if a shrunk copy of the hull
/// gives no bound. The whole surface of the solid must be visible from `center`. There is no bound if a face is badly
/// shaped, the center is not certainly behind a face, or there are too many faces and points.
///
/// The points behind the planes of all faces are in the solid: a ray from the center leaves the solid through a face, in
/// front of whose plane it stays. Let the center be `m` below a plane, and the hull's highest point `h` above the plane. A
/// copy of the hull, shrunk towards the center by the least `m / (m + h)` of all planes, is behind all of them. So a point
/// of the hull is at most `h / (m + h)` of its distance from the center away from the solid.
pub(super) fn excess_bound(target: &EnclosedMesh<'_>, hull: &Hull, center: DVec3) -> Option<f64> {
    let tests = target.triangles().len() as u64 * hull.points.len() as u64;
    if tests > EXCESS_WORK_BUDGET * PLANE_TESTS_PER_STEP as u64 {
        return None;
    }
    let mut largest_share = 0.0;
    for [a, b, c] in target.triangles() {
        let plane = Plane::from_corner_and_sides(a, b - a, c - a)?;
        let above = |point: &DVec3| plane.signed_distance(*point);
        let highest = hull.points.iter().map(above).fold(0.0, greater) + target.distance_rounding;
        let below = -plane.signed_distance(center) - target.distance_rounding;
        // Written so that NaN is no bound.
        if !(below > 0.0) {
            return None;
        }
        largest_share = greater(largest_share, highest / (below + highest));
    }
    let radii = hull.points.iter().map(|p| p.distance(center));
    Some(largest_share * radii.fold(0.0, greater) + target.distance_rounding)
}
