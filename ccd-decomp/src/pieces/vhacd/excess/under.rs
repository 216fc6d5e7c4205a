//! Bounds the excess of a part above a nearly flat surface.

use super::super::target::Target;
use super::super::voxels::clip_to_box;
use super::part_planes::Plane;
use crate::tolerance::MAX_NEARBY_TRIANGLES;
use crate::work::Work;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::vector::unit;

/// Bounds the distance from the solid to a part within a box, using the surface near the box; `None` if that fails.
///
/// Heights are measured along the mean normal of the surface in a box three times as large. The points of the large box
/// below that surface are a convex set without surface, which is in the solid if one point is. The bound is how far a
/// point of the small box sinks to get there, if it stays in the large box.
pub(super) fn excess_above_surface(
    target: &Target<'_>,
    planes: impl Iterator<Item = Plane>,
    [centre, half]: [DVec3; 2],
    work: &Work,
) -> Option<f64> {
    let bounds = [centre - 3.0 * half, centre + 3.0 * half];
    let near = target.triangles_in_box(bounds, MAX_NEARBY_TRIANGLES, work)?;
    let normals = near.iter().map(|[a, b, c]| (b - a).cross(c - a));
    let up = unit(target.orientation() * normals.sum::<DVec3>())?;
    let height = |p: DVec3| up.dot(p - centre);
    let mut part = Vec::new();
    let mut lowest = f64::INFINITY;
    for triangle in near {
        clip_to_box(&triangle, bounds, &mut part);
        lowest = part.iter().copied().map(height).fold(lowest, lesser);
    }
    lowest -= target.slack();
    let deepest = centre - 3.0 * half * up.signum();
    if !(height(deepest) < lowest) || !target.winds_about(deepest, work) {
        return None;
    }
    let sinks = greater(
        0.0,
        height_bound(planes, up, [centre, half], target.slack()) - lowest,
    );
    let stays = (sinks * up.abs()).cmple(2.0 * half).all();
    stays.then_some(sinks + target.slack())
}

/// Returns an upper bound of the height of a part within a box. The part is behind each plane: the upward direction
/// is split into a multiple of the plane's normal and a rest.
fn height_bound(
    planes: impl Iterator<Item = Plane>,
    up: DVec3,
    [centre, half]: [DVec3; 2],
    slack: f64,
) -> f64 {
    let by_plane = |plane: Plane| {
        let multiple = greater(0.0, up.dot(plane.normal));
        let rest = up - multiple * plane.normal;
        multiple * (slack - plane.signed_distance(centre)) + rest.abs().dot(half)
    };
    let by_box = up.abs().dot(half);
    planes.map(by_plane).fold(by_box, lesser)
}
