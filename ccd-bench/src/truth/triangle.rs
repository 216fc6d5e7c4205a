//! Computes the nearest points of two triangles, and directions that separate them.
//!
//! A referee's own: it shares no code with the rivals or the engine.

use super::surface::Triangle;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};

/// Returns the gap between the projections of two triangles on a direction from `b` to `a`; negative if they overlap.
pub(super) fn gap_along(n: DVec3, a: &Triangle, b: &Triangle) -> f64 {
    let [p, q, r] = a.map(|corner| n.dot(corner));
    let [u, v, w] = b.map(|corner| n.dot(corner));
    lesser(lesser(p, q), r) - greater(greater(u, v), w)
}

/// Returns the two face normals, then the cross products of all pairs of edges of two triangles, as unit vectors from
/// `b` towards `a`. Disjoint triangles that are not in one plane are apart along one of these directions. A normal that
/// does not exist is NaN.
pub(super) fn separating_axis_candidates(
    a: &Triangle,
    b: &Triangle,
) -> impl Iterator<Item = DVec3> {
    let [edges_a, edges_b] = [a, b].map(|t| [t[1] - t[0], t[2] - t[1], t[0] - t[2]]);
    let between = (a[0] + a[1] + a[2]) - (b[0] + b[1] + b[2]);
    let faces = [edges_b[0].cross(edges_b[1]), edges_a[0].cross(edges_a[1])];
    let crossed = (0..9).map(move |i| edges_a[i / 3].cross(edges_b[i % 3]));
    faces.into_iter().chain(crossed).map(move |n| {
        let n = n.normalize();
        if n.dot(between) < 0.0 { -n } else { n }
    })
}

/// Returns the nearest points of two disjoint triangles of any shape, up to rounding. If an edge pierces the other
/// triangle, the points may differ; see [`nearest_or_common_points`].
pub(super) fn nearest_points(a: &Triangle, b: &Triangle) -> (DVec3, DVec3) {
    let mut best = nearest_points_of_edges(a, b);
    for i in 0..3 {
        if let Some(q) = projection_in_triangle(a[i], b) {
            best = nearer_pair(best, (a[i], q));
        }
        if let Some(p) = projection_in_triangle(b[i], a) {
            best = nearer_pair(best, (p, b[i]));
        }
    }
    best
}

/// Returns the nearest points of two triangles as [`nearest_points`] does, or a common point if an edge pierces the other
/// triangle.
pub(super) fn nearest_or_common_points(a: &Triangle, b: &Triangle) -> (DVec3, DVec3) {
    let mut best = nearest_points(a, b);
    for i in 0..3 {
        if let Some((p, q)) = segment_triangle_crossing([a[i], a[(i + 1) % 3]], b) {
            best = nearer_pair(best, (p, q));
        }
        if let Some((q, p)) = segment_triangle_crossing([b[i], b[(i + 1) % 3]], a) {
            best = nearer_pair(best, (p, q));
        }
    }
    best
}

/// Returns the pair of points with the smaller distance, or `best` if the distances are equal.
fn nearer_pair(best: (DVec3, DVec3), found: (DVec3, DVec3)) -> (DVec3, DVec3) {
    let squared = |(p, q): (DVec3, DVec3)| (p - q).length_squared();
    if squared(found) < squared(best) {
        found
    } else {
        best
    }
}

fn nearest_points_of_edges(a: &Triangle, b: &Triangle) -> (DVec3, DVec3) {
    let mut best = (a[0], b[0]);
    for i in 0..3 {
        for j in 0..3 {
            let found = nearest_points_of_segments([a[i], a[(i + 1) % 3]], [b[j], b[(j + 1) % 3]]);
            best = nearer_pair(best, found);
        }
    }
    best
}

/// Returns the nearest points of two segments: it minimises |p + s u − q − t v| over s and t in 0..1.
fn nearest_points_of_segments([p, p_end]: [DVec3; 2], [q, q_end]: [DVec3; 2]) -> (DVec3, DVec3) {
    let (u, v, r) = (p_end - p, q_end - q, p - q);
    let (uu, vv, uv) = (u.length_squared(), v.length_squared(), u.dot(v));
    let (ur, vr) = (u.dot(r), v.dot(r));
    let fraction = |x: f64| if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) };
    let s = fraction((uv * vr - vv * ur) / (uu * vv - uv * uv));
    // Each parameter is the best for the other one fixed. A second round corrects the effect of clamping the
    // first.
    let t = fraction((uv * s + vr) / vv);
    let s = fraction((uv * t - ur) / uu);
    let t = fraction((uv * s + vr) / vv);
    (p + s * u, q + t * v)
}

/// Returns the projection of a point onto a triangle's plane if the projection is in the triangle.
fn projection_in_triangle(p: DVec3, [a, b, c]: &Triangle) -> Option<DVec3> {
    let (u, v, r) = (b - a, c - a, p - a);
    let n = u.cross(v);
    let square = n.length_squared();
    let beta = r.cross(v).dot(n) / square;
    let gamma = u.cross(r).dot(n) / square;
    (beta >= 0.0 && gamma >= 0.0 && beta + gamma <= 1.0).then(|| a + beta * u + gamma * v)
}

/// Returns where a segment crosses a triangle: the point on the segment, and the one on the triangle.
fn segment_triangle_crossing(
    [from, to]: [DVec3; 2],
    triangle: &Triangle,
) -> Option<(DVec3, DVec3)> {
    let [a, b, c] = triangle;
    let n = (b - a).cross(c - a);
    let (start, end) = (n.dot(from - a), n.dot(to - a));
    if start * end > 0.0 {
        return None;
    }
    let s = start / (start - end);
    let point = from + s.clamp(0.0, 1.0) * (to - from);
    projection_in_triangle(point, triangle).map(|on| (point, on))
}
