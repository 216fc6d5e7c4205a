//! Finds a common normal of two bodies' surfaces around a contact.

use crate::engine::meter::Meter;
use crate::engine::pieces::placed_pair::PlacedPair;
use crate::rounding::{ADJACENCY_DISTANCE_PER_ROUNDING, LEVEL_HEIGHT_PER_ROUNDING};
use glam::DVec3;

/// Returns a common normal of both surfaces at a contact: the one that is nearest to the direction `towards`, or close
/// to the nearest. Returns `None` unless the vector between both points is along that normal, up to rounding. The
/// points, of A and of B without their radii, and the directions are in A's frame.
pub(super) fn common_normal(
    placed: &PlacedPair<'_>,
    points: [DVec3; 2],
    towards: DVec3,
    meter: &mut Meter,
) -> Option<DVec3> {
    let PlacedPair {
        problem, pieces, ..
    } = placed;
    let reach = ADJACENCY_DISTANCE_PER_ROUNDING * problem.rounding;
    let (mut looks, turn) = (0, pieces.b_to_a.rotation);
    let normals = &mut meter.scratch_memory().normals;
    normals.reset(LEVEL_HEIGHT_PER_ROUNDING * problem.rounding);
    problem
        .a
        .body
        .visit_nearby_point_offsets(points[0], reach, |way| {
            looks += 1;
            normals.add_constraint_of_a(way);
        });
    let in_b = pieces.b_to_a.inverse_transform_point(points[1]);
    problem
        .b
        .body
        .visit_nearby_point_offsets(in_b, reach, |way| {
            looks += 1;
            normals.add_constraint_of_b(turn * way);
        });
    normals.sort_constraints();
    meter.stats.point_evaluations += looks;
    let normals = &meter.scratch_memory().normals;
    normals.nearest_normal_parallel_to(towards, points[1] - points[0])
}
