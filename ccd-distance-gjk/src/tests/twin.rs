//! Computes reference distances by brute force, over all points, edges and triangles that the points of a piece span.

use ccd_core::glam::DVec3;
use ccd_core::order::lesser;

/// Returns the distance of two hulls of few points that do not intersect.
pub(super) fn distance(a: &[DVec3], b: &[DVec3]) -> f64 {
    let mut best = f64::INFINITY;
    for &y in b {
        best = lesser(best, distance_from_point_to_hull(y, a));
    }
    for &x in a {
        best = lesser(best, distance_from_point_to_hull(x, b));
    }
    for [p, q] in edges(a) {
        for [r, s] in edges(b) {
            best = lesser(
                best,
                distance_between_crossing_edges(p, q, r, s).unwrap_or(best),
            );
        }
    }
    best
}

/// Returns the distance of a point from the nearest of a hull's points, edges and triangles.
fn distance_from_point_to_hull(x: DVec3, points: &[DVec3]) -> f64 {
    let corners = points.iter().map(|p| p.distance(x));
    let feet = edges(points).into_iter().filter_map(|[p, q]| {
        let d = q - p;
        let t = (x - p).dot(d) / d.length_squared();
        (t > 0.0 && t < 1.0).then(|| (p + t * d).distance(x))
    });
    let faces = edges(points).into_iter().flat_map(|[p, q]| {
        points
            .iter()
            .filter_map(move |&r| height_above_triangle(x, p, q, r))
    });
    corners.chain(feet).chain(faces).fold(f64::INFINITY, lesser)
}

/// Returns the distance of `x` from a triangle's plane; `None` if the projection of `x` is outside the triangle.
fn height_above_triangle(x: DVec3, p: DVec3, q: DVec3, r: DVec3) -> Option<f64> {
    let n = (q - p).cross(r - p);
    let foot = x - (x - p).dot(n) / n.length_squared() * n;
    let inside = [[p, q], [q, r], [r, p]]
        .iter()
        .all(|[s, t]| (t - s).cross(foot - s).dot(n) > 0.0);
    inside.then(|| foot.distance(x))
}

/// Returns the distance of two segments' lines; `None` unless their common perpendicular meets both segments inside.
fn distance_between_crossing_edges(p: DVec3, q: DVec3, r: DVec3, s: DVec3) -> Option<f64> {
    let (d, e, w) = (q - p, s - r, r - p);
    let n = d.cross(e);
    let along_first = w.cross(e).dot(n) / n.length_squared();
    let along_second = w.cross(d).dot(n) / n.length_squared();
    let inside = |t: f64| t > 0.0 && t < 1.0;
    (inside(along_first) && inside(along_second))
        .then(|| (p + along_first * d).distance(r + along_second * e))
}

fn edges(points: &[DVec3]) -> Vec<[DVec3; 2]> {
    let later = |k: usize| points[k + 1..].iter().map(move |&q| [points[k], q]);
    (0..points.len()).flat_map(later).collect()
}
