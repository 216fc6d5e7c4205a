//! Computes the nearest points of a triangle and a point, and of two edges, in closed form `[ERICSON05 §5.1]`.

use crate::math::order::lesser;
use glam::DVec3;

/// The part of a triangle that contains a point: its interior, an edge or a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TrianglePart {
    Corner(usize),
    /// The edge from corner `k` to the next one.
    Edge(usize),
    Interior,
}

/// Returns the point of a triangle that is nearest to `from`, and the smallest part of the triangle that is as near, up
/// to `rounding`. The triangle may be a segment or a point.
///
/// Even if a weight suffers cancellation, the point is in the triangle, so that its distance is
/// never too small.
pub(super) fn nearest_point_on_triangle(
    from: DVec3,
    corners: [DVec3; 3],
    rounding: f64,
) -> (TrianglePart, DVec3) {
    let next = |k: usize| corners[(k + 1) % 3];
    let corner = |k| (TrianglePart::Corner(k), corners[k]);
    let edge = |k| {
        Some((
            TrianglePart::Edge(k),
            project_to_segment(from, [corners[k], next(k)])?,
        ))
    };
    let inside = project_to_triangle(from, corners).map(|foot| (TrianglePart::Interior, foot));
    // The smallest parts come first: a smaller part is taken if no larger one is nearer.
    let parts = [
        Some(corner(0)),
        Some(corner(1)),
        Some(corner(2)),
        edge(0),
        edge(1),
        edge(2),
        inside,
    ];
    let way = |&(_, at): &(TrianglePart, DVec3)| from.distance(at);
    let mut best = corner(0);
    for part in parts.into_iter().flatten() {
        let nearer = if is_same_part_kind(part.0, best.0) {
            way(&part) < way(&best)
        } else {
            way(&part) + rounding < way(&best)
        };
        if nearer {
            best = part;
        }
    }
    best
}

/// Returns the nearest points of two edges if both points are interior to their edges. They must be nearer than any end
/// is to the other edge, by more than `rounding`. Edges that are parallel, or meet at an end, do not cross.
pub(super) fn nearest_points_on_crossing_edges(
    e: [DVec3; 2],
    f: [DVec3; 2],
    rounding: f64,
) -> Option<[DVec3; 2]> {
    let (along_e, along_f, way) = (e[1] - e[0], f[1] - f[0], f[0] - e[0]);
    let across = along_e.cross(along_f);
    let start = way.cross(along_f).dot(across) / across.length_squared();
    let inner = |p: DVec3, edge: [DVec3; 2]| project_to_segment(p, edge);
    // Two projections correct the share after cancellation. A NaN is in no range.
    if !(start > 0.0 && start < 1.0) {
        return None;
    }
    let q = inner(e[0] + start * along_e, f)?;
    let p = inner(q, e)?;
    let q = inner(p, f)?;
    let ends = [
        e[0].distance(nearest_point_on_segment(e[0], f)),
        e[1].distance(nearest_point_on_segment(e[1], f)),
        f[0].distance(nearest_point_on_segment(f[0], e)),
        f[1].distance(nearest_point_on_segment(f[1], e)),
    ];
    let nearest_end = ends.into_iter().fold(f64::INFINITY, lesser);
    (p.distance(q) + rounding < nearest_end).then_some([p, q])
}

fn is_same_part_kind(one: TrianglePart, other: TrianglePart) -> bool {
    std::mem::discriminant(&one) == std::mem::discriminant(&other)
}

/// Projects a point onto a segment; `None` if the projection is beyond the ends.
fn project_to_segment(from: DVec3, [a, b]: [DVec3; 2]) -> Option<DVec3> {
    let along = b - a;
    let share = (from - a).dot(along) / along.length_squared();
    // False for NaN, and for a segment of no length.
    (share > 0.0 && share < 1.0).then(|| a + share * along)
}

/// Returns the point of a segment that is nearest to `from`.
fn nearest_point_on_segment(from: DVec3, edge: [DVec3; 2]) -> DVec3 {
    let nearer_end = if from.distance_squared(edge[1]) < from.distance_squared(edge[0]) {
        edge[1]
    } else {
        edge[0]
    };
    project_to_segment(from, edge).unwrap_or(nearer_end)
}

/// Projects a point onto a triangle; `None` if the projection is outside the triangle.
fn project_to_triangle(from: DVec3, [a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v);
    let square = normal.length_squared();
    let weights = |way: DVec3| {
        let of_u = way.cross(v).dot(normal) / square;
        let of_v = u.cross(way).dot(normal) / square;
        (of_u, of_v)
    };
    let (s, t) = weights(from - a);
    // Projecting the residual once more corrects the weights after cancellation.
    let (more_s, more_t) = weights(from - (a + s * u + t * v));
    let (s, t) = (s + more_s, t + more_t);
    (s > 0.0 && t > 0.0 && s + t < 1.0).then(|| a + s * u + t * v)
}
