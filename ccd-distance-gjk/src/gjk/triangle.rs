//! The point of a triangle that is nearest to the origin.

use super::foot::NearestPoint;
use super::segment;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};

/// Returns the point of the triangle `a`, `b`, `c`, which may be degenerate, that is nearest to the origin.
///
/// The foot is inside of the face if the origin is inside of all three edges. Otherwise it is the
/// nearest foot on the edges that the origin is outside of. A triangle so flat that rounding may
/// decide the sides is also compared with all of its edges.
pub(crate) fn nearest_point(a: DVec3, b: DVec3, c: DVec3) -> NearestPoint {
    let corners = [a, b, c];
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let n = ab.cross(ac);
    // Twice the areas, times |n|², that the origin's foot spans with each edge; each edge's weight
    // belongs to the opposite corner.
    let areas = [b.cross(bc).dot(n), -c.cross(ac).dot(n), a.cross(ab).dot(n)];
    let inside = areas.iter().all(|&area| area > 0.0);
    // sin² of the angle at `a` below which areas lose half of their digits.
    let flat = n.length_squared()
        <= f64::EPSILON * ab.length_squared() * greater(ac.length_squared(), bc.length_squared());
    let mut best = inside.then(|| nearest_in_face(corners, n, areas));
    for (opposite, &area) in areas.iter().enumerate() {
        if flat || !inside && !(area > 0.0) {
            let edge = [(opposite + 1) % 3, (opposite + 2) % 3];
            let on_edge = segment::nearest_point(corners[edge[0]], corners[edge[1]])
                .lifted_to_whole_simplex(&edge);
            best = Some(on_edge.nearer_of(best));
        }
    }
    best.unwrap_or(NearestPoint::at_vertex(a, 0))
}

/// Returns the point of the face nearest to the origin. Its barycentric coordinates are in proportion to `areas`, each
/// opposite to its corner.
fn nearest_in_face(corners: [DVec3; 3], n: DVec3, areas: [f64; 3]) -> NearestPoint {
    let square = |k: usize| (corners[(k + 1) % 3] - corners[k]).length_squared();
    let start = (1..3).fold(0, |best, k| if square(k) > square(best) { k } else { best });
    let end = (start + 1) % 3;
    let (edge, length2) = (corners[end] - corners[start], square(start));
    // In a needle, rounding tilts the normal and changes the areas. That is corrected along the longest edge; across it
    // errors are at most the needle's width.
    let n = n - edge * (n.dot(edge) / length2);
    let total = areas[0] + areas[1] + areas[2];
    let mut weights = areas.map(|area| area / total);
    let back = weighted_sum(corners, weights).dot(edge) / length2;
    // Clamped to the edges.
    let back = lesser(weights[end], greater(-weights[start], back));
    weights[start] += back;
    weights[end] -= back;
    let point = weighted_sum(corners, weights);
    NearestPoint {
        weights: [weights[0], weights[1], weights[2], 0.0],
        point,
        direction: Some(less_tilted_direction(corners, n, point, length2)),
    }
}

/// Returns the triangle's normal, oriented away from the origin, or the vector to `point`: whichever rounding tilts
/// less.
///
/// The tilt of the normal is inverse to the triangle's height relative to the longest edge, that of the foot to its
/// length relative to the corners'.
fn less_tilted_direction(corners: [DVec3; 3], n: DVec3, point: DVec3, length2: f64) -> DVec3 {
    let reach = corners
        .iter()
        .map(|c| c.length_squared())
        .fold(0.0, greater);
    if point.length_squared() * length2 * length2 > n.length_squared() * reach {
        point
    } else if corners[0].dot(n) < 0.0 {
        -n
    } else {
        n
    }
}

fn weighted_sum(corners: [DVec3; 3], [u, v, w]: [f64; 3]) -> DVec3 {
    corners[0] * u + corners[1] * v + corners[2] * w
}
