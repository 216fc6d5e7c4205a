//! Computes the nearest points of two triangles that do not intersect: edge against edge, corner against face.

use crate::lanes::{FourVectors, clamp_to_unit_interval, reciprocal_or_zero, splat};
use ccd_core::fearless_simd::{Level, Simd, f64x4, prelude::*};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::vectorize;

/// The three corners of a triangle; for a segment or a point, the last corner is repeated.
pub(crate) type Corners = [DVec3; 3];

/// Returns the support gap `min_Q n·y − max_P n·x` of two triangles along `n`, not divided by the length of `n`.
#[inline(always)]
pub(crate) fn support_gap(p: &Corners, q: &Corners, n: DVec3) -> f64 {
    let [a, b, c] = p.map(|x| n.dot(x));
    let [d, e, f] = q.map(|y| n.dot(y));
    lesser(lesser(d, e), f) - greater(greater(a, b), c)
}

/// The nearest points of two triangles, in barycentric coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearestPoints {
    pub(crate) a: [f64; 3],
    pub(crate) b: [f64; 3],
}

impl NearestPoints {
    /// Returns the vector from the first triangle's nearest point to the second triangle's.
    #[inline(always)]
    pub(crate) fn separation_vector(&self, p: &Corners, q: &Corners) -> DVec3 {
        point_at_weights(q, self.b) - point_at_weights(p, self.a)
    }
}

/// Returns the nearest points of two triangles that do not intersect `[ERICSON05 §5.1]`: those of their boundaries, or
/// of a corner and a face.
///
/// Every candidate is a valid pair of points, however ill-conditioned; the least distance decides.
pub(crate) fn nearest_points(level: Level, p: &Corners, q: &Corners) -> NearestPoints {
    vectorize!(level, level => nearest_points_in_lanes(level, p, q))
}

#[inline(always)]
fn nearest_points_in_lanes<L: Simd>(level: L, p: &Corners, q: &Corners) -> NearestPoints {
    let edges = nearest_edge_points(level, p, q);
    let corners_q = project_corners_to_face(level, p, q);
    let corners_p = project_corners_to_face(level, q, p);
    let face_p = corners_q
        .squared_distance
        .simd_lt(corners_p.squared_distance);
    let faces = corners_q.squared_distance.min(corners_p.squared_distance);
    let (at_edges, at_faces) = (least_lane(edges.squared_distance), least_lane(faces));
    if at_edges.0 <= at_faces.0 {
        return edges.weights(at_edges.1);
    }
    let k = at_faces.1;
    if face_p.to_bitmask() >> k & 1 == 1 {
        let (a, b) = corners_q.weights(k);
        NearestPoints { a, b }
    } else {
        let (b, a) = corners_p.weights(k);
        NearestPoints { a, b }
    }
}

/// For every edge of the second triangle, one per lane, the nearest edge of the first triangle.
struct NearestEdgePerLane<L: Simd> {
    squared_distance: f64x4<L>,
    /// The index of the first triangle's edge.
    edge: f64x4<L>,
    /// The parameter of the nearest point along the first triangle's edge.
    s: f64x4<L>,
    /// The parameter of the nearest point along the second triangle's edge.
    t: f64x4<L>,
}

impl<L: Simd> NearestEdgePerLane<L> {
    #[inline(always)]
    fn weights(&self, lane: usize) -> NearestPoints {
        let (i, j) = (self.edge[lane] as usize, EDGE_START_OF_LANE[lane]);
        NearestPoints {
            a: weights_on_edge(i, self.s[lane]),
            b: weights_on_edge(j, self.t[lane]),
        }
    }
}

/// The start corner of the edge in each lane; the fourth lane repeats the third corner.
const EDGE_START_OF_LANE: [usize; 4] = [0, 1, 2, 2];

#[inline(always)]
fn nearest_edge_points<L: Simd>(level: L, p: &Corners, q: &Corners) -> NearestEdgePerLane<L> {
    let starts = FourVectors::new(level, EDGE_START_OF_LANE.map(|k| q[k]));
    let f = FourVectors::new(level, [q[1] - q[0], q[2] - q[1], q[0] - q[2], DVec3::ZERO]);
    let per_f = reciprocal_or_zero(f.dot(f));
    let mut best = NearestEdgePerLane {
        squared_distance: splat(level, f64::INFINITY),
        edge: splat(level, 0.0),
        s: splat(level, 0.0),
        t: splat(level, 0.0),
    };
    for i in 0..3 {
        let e = FourVectors::splat(level, p[(i + 1) % 3] - p[i]);
        let per_e = reciprocal_or_zero(e.dot(e));
        let w = starts.subtract(FourVectors::splat(level, p[i]));
        // The lines cross at s = ((w×f)·n) / n² with n = e×f. Unlike the determinant of scalar
        // products, this keeps an error of rounding / angle when the edges are nearly parallel.
        let n = e.cross(f);
        let s = clamp_to_unit_interval(w.cross(f).dot(n) * reciprocal_or_zero(n.dot(n)));
        // Projects to the other edge, and back: exact where the first or second was clamped, and
        // where the lines are parallel.
        let t = clamp_to_unit_interval(-w.add_scaled(-s, e).dot(f) * per_f);
        let reached = w.add_scaled(t, f);
        let s = clamp_to_unit_interval(reached.dot(e) * per_e);
        let apart = reached.add_scaled(-s, e);
        let square = apart.dot(apart);
        let better = square.simd_lt(best.squared_distance);
        best.squared_distance = better.select(square, best.squared_distance);
        best.edge = better.select(splat(level, i as f64), best.edge);
        best.s = better.select(s, best.s);
        best.t = better.select(t, best.t);
    }
    best
}

/// For every corner of one triangle, one per lane, its projection onto the face of the other triangle.
struct CornerToFaceProjections<L: Simd> {
    /// The squared distance of the corner from its projection; infinite if the projection is outside of the face.
    squared_distance: f64x4<L>,
    u: f64x4<L>,
    v: f64x4<L>,
}

impl<L: Simd> CornerToFaceProjections<L> {
    /// Returns the barycentric coordinates of the projection in the face, and of the corner in its own triangle.
    #[inline(always)]
    fn weights(&self, lane: usize) -> ([f64; 3], [f64; 3]) {
        let (u, v) = (self.u[lane], self.v[lane]);
        let mut corner = [0.0; 3];
        corner[EDGE_START_OF_LANE[lane]] = 1.0;
        ([1.0 - u - v, u, v], corner)
    }
}

#[inline(always)]
fn project_corners_to_face<L: Simd>(
    level: L,
    face: &Corners,
    corners: &Corners,
) -> CornerToFaceProjections<L> {
    let (e, f) = (face[1] - face[0], face[2] - face[0]);
    let n = e.cross(f);
    let square = n.length_squared();
    let per = if square > 0.0 { 1.0 / square } else { 0.0 };
    // The dual basis of the two edges within the plane: u = w·g, v = w·h.
    let (g, h) = (per * f.cross(n), per * n.cross(e));
    let w = FourVectors::new(level, EDGE_START_OF_LANE.map(|k| corners[k] - face[0]));
    let u = w.dot(FourVectors::splat(level, g));
    let v = w.dot(FourVectors::splat(level, h));
    let apart = w
        .add_scaled(-u, FourVectors::splat(level, e))
        .add_scaled(-v, FourVectors::splat(level, f));
    let zero = splat(level, 0.0);
    let inside = u.simd_ge(zero) & v.simd_ge(zero) & (splat(level, 1.0) - u - v).simd_gt(zero);
    CornerToFaceProjections {
        squared_distance: inside.select(apart.dot(apart), splat(level, f64::INFINITY)),
        u,
        v,
    }
}

/// Returns the least of four values, and the lane that holds it.
#[inline(always)]
fn least_lane<L: Simd>(x: f64x4<L>) -> (f64, usize) {
    let low = if x[1] < x[0] { 1 } else { 0 };
    let high = if x[3] < x[2] { 3 } else { 2 };
    let lane = if x[high] < x[low] { high } else { low };
    (x[lane], lane)
}

#[inline(always)]
fn weights_on_edge(start: usize, t: f64) -> [f64; 3] {
    let mut out = [0.0; 3];
    out[start] = 1.0 - t;
    out[(start + 1) % 3] += t;
    out
}

/// Returns the point with the given barycentric coordinates.
#[inline(always)]
pub(crate) fn point_at_weights(corners: &Corners, [u, v, w]: [f64; 3]) -> DVec3 {
    u * corners[0] + v * corners[1] + w * corners[2]
}
