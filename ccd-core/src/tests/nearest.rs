//! Finds the nearest points of two triangles by brute force. It compares every edge with every edge, and every corner
//! and every edge of each triangle with the other triangle.
//!
//! A separate crate of tests could not provide it: that crate would depend on this one, which would be built twice.

use crate::math::order::lesser;
use glam::DVec3;

pub(crate) type Triangle = [DVec3; 3];

/// The nearest points of two triangles, by their barycentric coordinates, and their distance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearestPoints {
    pub(crate) a: [f64; 3],
    pub(crate) b: [f64; 3],
    pub(crate) distance: f64,
}

/// Finds the nearest points of two triangles, which may be degenerate: segments or points.
///
/// Every candidate is a pair of points of the two triangles, so that rounding can only make the
/// distance too large.
pub(crate) fn nearest_points(a: &Triangle, b: &Triangle) -> NearestPoints {
    let mut best = NearestPoints {
        a: [1.0, 0.0, 0.0],
        b: [1.0, 0.0, 0.0],
        distance: f64::INFINITY,
    };
    let mut offer = |wa: [f64; 3], wb: [f64; 3]| {
        let distance = (point(b, wb) - point(a, wa)).length();
        if distance < best.distance {
            best = NearestPoints {
                a: wa,
                b: wb,
                distance,
            };
        }
    };
    for i in 0..3 {
        for j in 0..3 {
            let (s, t) = nearest_segment_parameters(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
            offer(edge_point_weights(i, s), edge_point_weights(j, t));
        }
        if let Some(weights) = foot_weights(b, a[i]) {
            offer(corner(i), weights);
        }
        if let Some(weights) = foot_weights(a, b[i]) {
            offer(weights, corner(i));
        }
        if let Some((s, weights)) = piercing_point(b, a[i], a[(i + 1) % 3]) {
            offer(edge_point_weights(i, s), weights);
        }
        if let Some((s, weights)) = piercing_point(a, b[i], b[(i + 1) % 3]) {
            offer(weights, edge_point_weights(i, s));
        }
    }
    best
}

pub(crate) fn point(t: &Triangle, weights: [f64; 3]) -> DVec3 {
    // The point is relative to a corner, so that rounding stays that of the triangle's size.
    t[0] + weights[1] * (t[1] - t[0]) + weights[2] * (t[2] - t[0])
}

fn corner(k: usize) -> [f64; 3] {
    edge_point_weights(k, 0.0)
}

fn edge_point_weights(k: usize, t: f64) -> [f64; 3] {
    let mut weights = [0.0; 3];
    weights[k] = 1.0 - t;
    weights[(k + 1) % 3] += t;
    weights
}

/// Returns the parameters, from 0 to 1, of the nearest points of two segments.
fn nearest_segment_parameters(p: DVec3, p_end: DVec3, q: DVec3, q_end: DVec3) -> (f64, f64) {
    let (d, e, r) = (p_end - p, q_end - q, p - q);
    let (dd, ee, de) = (d.dot(d), e.dot(e), d.dot(e));
    let clamp = |x: f64| if x > 0.0 { lesser(1.0, x) } else { 0.0 };
    let denominator = dd * ee - de * de;
    let mut s = clamp((de * e.dot(r) - d.dot(r) * ee) / denominator);
    let mut t = 0.0;
    // Alternating projections correct the first guess after cancellation.
    for _ in 0..3 {
        t = clamp(e.dot(p + s * d - q) / ee);
        s = clamp(d.dot(q + t * e - p) / dd);
    }
    (s, t)
}

/// Projects a point onto a triangle's plane, and returns the barycentric coordinates of the projection; `None` if it is
/// outside the triangle.
fn foot_weights(t: &Triangle, from: DVec3) -> Option<[f64; 3]> {
    let (u, v) = (t[1] - t[0], t[2] - t[0]);
    let normal = u.cross(v);
    let square = normal.length_squared();
    let way = from - t[0];
    let weights_u = way.cross(v).dot(normal) / square;
    let weights_v = u.cross(way).dot(normal) / square;
    weights_if_inside(weights_u, weights_v)
}

/// Returns the point where a segment meets a triangle, by its parameter on the segment and its barycentric coordinates.
fn piercing_point(t: &Triangle, p: DVec3, q: DVec3) -> Option<(f64, [f64; 3])> {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]);
    let (from, to) = (normal.dot(p - t[0]), normal.dot(q - t[0]));
    if !(from * to <= 0.0 && from != to) {
        return None;
    }
    let s = (from / (from - to)).clamp(0.0, 1.0);
    Some((s, foot_weights(t, p + s * (q - p))?))
}

fn weights_if_inside(u: f64, v: f64) -> Option<[f64; 3]> {
    // Written so that NaN is outside.
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then_some([1.0 - u - v, u, v])
}

#[test]
fn finds_corners_edges_faces_and_crossings() {
    let flat = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let cases = [
        (
            [
                DVec3::new(0.2, 0.2, 1.0),
                DVec3::new(0.2, 0.2, 2.0),
                DVec3::new(3.0, 3.0, 3.0),
            ],
            1.0,
        ),
        (
            [
                DVec3::new(-1.0, 0.0, 0.0),
                DVec3::new(-2.0, 1.0, 0.0),
                DVec3::new(-2.0, -1.0, 0.0),
            ],
            1.0,
        ),
        (
            [
                DVec3::new(0.5, -1.0, -1.0),
                DVec3::new(0.5, -1.0, 1.0),
                DVec3::new(0.5, -9.0, 0.0),
            ],
            1.0,
        ),
        (
            [
                DVec3::new(0.2, 0.2, -1.0),
                DVec3::new(0.2, 0.2, 1.0),
                DVec3::new(9.0, 9.0, 0.0),
            ],
            0.0,
        ),
        ([DVec3::new(2.0, 0.0, 0.0); 3], 1.0),
    ];
    for (other, distance) in cases {
        assert!(
            (nearest_points(&flat, &other).distance - distance).abs() < 1e-15,
            "{other:?}"
        );
        assert!(
            (nearest_points(&other, &flat).distance - distance).abs() < 1e-15,
            "{other:?}"
        );
    }
}
