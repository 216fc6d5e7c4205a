//! Bounds how far a hull extends beyond a nearly flat part of a solid's surface.

use super::enclosed_mesh::EnclosedMesh;
use super::facet_planes::Plane;
use crate::tolerance::MAX_NEARBY_TRIANGLES;
use crate::work::WorkBudget;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::vector::unit;

/// Returns an upper bound on the distance from the solid to the hull within a box, from the heights of the surface near
/// the box; `None` if there is no such bound.
///
/// Heights are measured along the mean normal of the surface in a box three times as large. The points of the large box
/// below that surface are a convex set without surface, which is in the solid if one point is. The bound is how far a
/// point of the small box sinks to get there, if it stays in the large box.
pub(super) fn excess_bound_above_surface(
    target: &EnclosedMesh<'_>,
    planes: impl Iterator<Item = Plane>,
    [center, half]: [DVec3; 2],
    work: &WorkBudget,
) -> Option<f64> {
    let bounds = [center - 3.0 * half, center + 3.0 * half];
    let near = target.triangles_meeting_box(bounds, MAX_NEARBY_TRIANGLES, work)?;
    let normals = near.iter().map(|[a, b, c]| (b - a).cross(c - a));
    let up = unit(target.orientation_sign * normals.sum::<DVec3>())?;
    let height = |p: DVec3| up.dot(p - center);
    let mut part = Vec::new();
    let mut lowest = f64::INFINITY;
    for triangle in near {
        clip_to_box(&triangle, bounds, &mut part);
        lowest = part.iter().copied().map(height).fold(lowest, lesser);
    }
    lowest -= target.distance_rounding;
    let deepest = center - 3.0 * half * up.signum();
    if !(height(deepest) < lowest) || !target.has_nonzero_winding_number(deepest, work) {
        return None;
    }
    let sinks = greater(
        0.0,
        hull_height_bound(planes, up, [center, half], target.distance_rounding) - lowest,
    );
    let stays = (sinks * up.abs()).cmple(2.0 * half).all();
    stays.then_some(sinks + target.distance_rounding)
}

/// Returns an upper bound of the height of the hull within a box, along `up` from the box's center. The hull is behind
/// each plane: the upward direction is split into a multiple of the plane's normal and a rest.
fn hull_height_bound(
    planes: impl Iterator<Item = Plane>,
    up: DVec3,
    [center, half]: [DVec3; 2],
    slack: f64,
) -> f64 {
    let by_plane = |plane: Plane| {
        let multiple = greater(0.0, up.dot(plane.normal));
        let rest = up - multiple * plane.normal;
        multiple * (slack - plane.signed_distance(center)) + rest.abs().dot(half)
    };
    let by_box = up.abs().dot(half);
    planes.map(by_plane).fold(by_box, lesser)
}

/// Clips a triangle to a box, and stores the resulting polygon in `part`.
fn clip_to_box(triangle: &[DVec3; 3], [lo, hi]: [DVec3; 2], part: &mut Vec<DVec3>) {
    let mut rest = Vec::new();
    part.clear();
    part.extend(triangle);
    for axis in 0..3 {
        clip_to_half_space(part, axis, |x| x >= lo[axis], lo[axis], &mut rest);
        clip_to_half_space(&rest, axis, |x| x <= hi[axis], hi[axis], part);
    }
}

/// Clips a convex polygon to one side of a plane (Sutherland and Hodgman).
fn clip_to_half_space(
    polygon: &[DVec3],
    axis: usize,
    keeps: impl Fn(f64) -> bool,
    plane: f64,
    part: &mut Vec<DVec3>,
) {
    part.clear();
    let next = polygon.iter().cycle().skip(1);
    for (&p, &q) in polygon.iter().zip(next) {
        if keeps(p[axis]) {
            part.push(p);
        }
        if keeps(p[axis]) != keeps(q[axis]) {
            // An edge gives the same point from either side.
            let (p, q) = if p[axis] < q[axis] { (p, q) } else { (q, p) };
            let mut between = p + (plane - p[axis]) / (q[axis] - p[axis]) * (q - p);
            between[axis] = plane;
            part.push(between);
        }
    }
}

#[cfg(test)]
mod tests;
