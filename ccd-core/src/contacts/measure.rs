//! Bounds the distance of two features from below by a gap along an axis, and from above by two points.

use super::candidate::ContactCandidate;
use super::skin::{NearSurface, SurfacePart};
use crate::answer::{Contact, Separation};
use crate::distance::common_normals::CommonNormals;
use crate::math::order::{greater, lesser};
use crate::math::vector::{self, normal, unit};
use crate::motion::pose::Frame;
use crate::problem::Problem;
use crate::rounding::is_direction_uncertain;
use glam::DVec3;

/// A pair of surface parts: a corner, edge or face of A, and one of B.
pub(super) type SurfacePartPair = [SurfacePart; 2];

/// Creates the reported pair of two features from their nearest points, with bounds of the distance, in world
/// coordinates. `a_to_world` is A's frame, relative to the problem's origin. If the points are too near each other to
/// give a direction, a normal from `common_normals` is used.
///
/// # Guarantee
/// `lower ≤ distance ≤ upper` for any points: the gap of the features' corners along any axis
/// bounds their distance from below, any two points bound it from above.
pub(super) fn measure_feature_pair(
    problem: &Problem<'_>,
    skins: [&NearSurface<'_>; 2],
    a_to_world: &Frame,
    (spots, candidate): &(SurfacePartPair, ContactCandidate),
    common_normals: impl Fn([DVec3; 2]) -> CommonNormals,
) -> Contact {
    let face = |k: usize| skins[k].face(candidate.faces[k]);
    let points = [0, 1].map(|k| skins[k].part_points(spots[k], candidate.faces[k]));
    let [a, b] = candidate.points;
    let (distance, radii) = (vector::distance(a, b), face(0).radius + face(1).radius);
    let towards = if distance > problem.rounding {
        b - a
    } else {
        direction_from_a_to_b(skins, spots, candidate)
    };
    let mut normal = unit(towards).unwrap_or(DVec3::X);
    for across in candidate_normals(&points).into_iter().flatten() {
        let across = if across.dot(towards) < 0.0 {
            -across
        } else {
            across
        };
        if support_gap(&points, across) > support_gap(&points, normal) {
            normal = across;
        }
    }
    if is_direction_uncertain(distance, problem.rounding)
        && let Some(common) =
            common_normals(candidate.points).nearest_normal_parallel_to(normal, b - a)
    {
        normal = common;
    }
    let way = unit(b - a).unwrap_or(normal);
    let world = |x: DVec3| problem.to_world_point(a_to_world.transform_point(x));
    let name = |k: usize| skins[k].feature_of(spots[k], candidate.faces[k]);
    Contact {
        feature_a: name(0),
        feature_b: name(1),
        piece_a: problem.a.index_in_given_body(face(0).piece),
        piece_b: problem.b.index_in_given_body(face(1).piece),
        separation: Separation {
            lower: support_gap(&points, normal) - radii - problem.rounding,
            upper: greater(0.0, distance - radii) + problem.rounding,
            normal: unit(a_to_world.rotation * normal).unwrap_or(normal),
            witness_a: world(a + way * face(0).radius),
            witness_b: world(b - way * face(1).radius),
        },
    }
}

/// Returns the gap `min_B n·y − max_A n·x` of two features along `n`; negative if their projections overlap.
fn support_gap([a, b]: &[[DVec3; 3]; 2], n: DVec3) -> f64 {
    let from = a[0];
    let highest = a
        .map(|x| n.dot(x - from))
        .into_iter()
        .fold(f64::NEG_INFINITY, greater);
    let lowest = b
        .map(|y| n.dot(y - from))
        .into_iter()
        .fold(f64::INFINITY, lesser);
    lowest - highest
}

/// Returns candidates for the contact normal: the normals of both features, and the cross product of their edges. The
/// normal of a face is exact to the last digits, even if the vector between the nearest points is mostly rounding.
fn candidate_normals([a, b]: &[[DVec3; 3]; 2]) -> [Option<DVec3>; 3] {
    let along = |of: &[DVec3; 3]| of[1] - of[0];
    [
        normal(*a),
        normal(*b),
        unit(vector::vector_perpendicular_to_both(along(a), along(b))),
    ]
}

/// Returns an approximate direction from A to B for features that touch: out of A's surface and into B's surface. For
/// surfaces without an outside it leads from the middle of one piece to the middle of the other.
fn direction_from_a_to_b(
    skins: [&NearSurface<'_>; 2],
    spots: &[SurfacePart; 2],
    candidate: &ContactCandidate,
) -> DVec3 {
    let out = |k: usize| {
        let out = skins[k].outward_direction(spots[k], candidate.faces[k]);
        unit(out).unwrap_or(DVec3::ZERO)
    };
    let middle = |k: usize| skins[k].mean_of_points(skins[k].face(candidate.faces[k]).piece);
    match out(0) - out(1) {
        DVec3::ZERO => middle(1) - middle(0),
        towards => towards,
    }
}
