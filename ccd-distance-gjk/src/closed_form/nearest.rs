//! Nearest points of two triangles that do not intersect: edge against edge, corner against face.

use crate::lanes::{Lanes3, clamp_unit, reciprocal};
use ccd_core::glam::DVec3;
use wide::f64x4;

/// The corners of a triangle, a segment or a point, the last one repeated.
pub(crate) type Corners = [DVec3; 3];

/// A point of each triangle, by the weights of its corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    pub(crate) a: [f64; 3],
    pub(crate) b: [f64; 3],
}

impl Nearest {
    /// Returns the point of the second triangle minus that of the first.
    #[inline]
    pub(crate) fn difference(&self, p: &Corners, q: &Corners) -> DVec3 {
        at(q, self.b) - at(p, self.a)
    }
}

/// Returns the nearest points of two triangles that do not intersect `[ERICSON05 §5.1]`: those of their
/// boundaries, and of corners and faces.
///
/// Every candidate is a pair of points of the triangles, however ill-conditioned; the least
/// distance decides.
#[inline]
pub(crate) fn nearest(p: &Corners, q: &Corners) -> Nearest {
    let edges = edges_to_edges(p, q);
    let corners_q = corners_to_face(p, q);
    let corners_p = corners_to_face(q, p);
    let face_p = corners_q.square.simd_lt(corners_p.square);
    let faces = corners_q.square.fast_min(corners_p.square);
    let (at_edges, at_faces) = (least(edges.square), least(faces));
    if at_edges.0 <= at_faces.0 {
        return edges.weights(at_edges.1);
    }
    let k = at_faces.1;
    if face_p.to_bitmask() >> k & 1 == 1 {
        let (a, b) = corners_q.weights(k);
        Nearest { a, b }
    } else {
        let (b, a) = corners_p.weights(k);
        Nearest { a, b }
    }
}

/// The best partner of every edge of the second triangle among those of the first.
struct EdgeEdge {
    square: f64x4,
    /// The edge of the first triangle.
    edge: f64x4,
    /// The parameter along that edge.
    s: f64x4,
    /// The parameter along the second triangle's edge.
    t: f64x4,
}

impl EdgeEdge {
    #[inline]
    fn weights(&self, lane: usize) -> Nearest {
        let (i, j) = (self.edge.to_array()[lane] as usize, LANE_CORNER[lane]);
        Nearest {
            a: on_edge(i, self.s.to_array()[lane]),
            b: on_edge(j, self.t.to_array()[lane]),
        }
    }
}

/// The corner at which the edge in each lane begins; the fourth edge is the third corner alone.
const LANE_CORNER: [usize; 4] = [0, 1, 2, 2];

#[inline]
fn edges_to_edges(p: &Corners, q: &Corners) -> EdgeEdge {
    let starts = Lanes3::new(LANE_CORNER.map(|k| q[k]));
    let f = Lanes3::new([q[1] - q[0], q[2] - q[1], q[0] - q[2], DVec3::ZERO]);
    let per_f = reciprocal(f.dot(f));
    let mut best = EdgeEdge {
        square: f64x4::splat(f64::INFINITY),
        edge: f64x4::ZERO,
        s: f64x4::ZERO,
        t: f64x4::ZERO,
    };
    for i in 0..3 {
        let e = Lanes3::splat(p[(i + 1) % 3] - p[i]);
        let per_e = reciprocal(e.dot(e));
        let w = starts.minus(Lanes3::splat(p[i]));
        // The lines cross at s = ((w×f)·n) / n² with n = e×f. Unlike the determinant of scalar
        // products, this keeps an error of rounding / angle when the edges are nearly parallel.
        let n = e.cross(f);
        let s = clamp_unit(w.cross(f).dot(n) * reciprocal(n.dot(n)));
        // Projects to the other edge, and back: exact where the first or second was clamped, and
        // where the lines are parallel.
        let t = clamp_unit(e_minus_w(e, s, w).dot(f) * per_f);
        let reached = w.along(t, f);
        let s = clamp_unit(reached.dot(e) * per_e);
        let apart = reached.back(s, e);
        let square = apart.dot(apart);
        let better = square.simd_lt(best.square);
        best.square = better.select(square, best.square);
        best.edge = better.select(f64x4::splat(i as f64), best.edge);
        best.s = better.select(s, best.s);
        best.t = better.select(t, best.t);
    }
    best
}

/// Returns `s e − w`.
#[inline(always)]
fn e_minus_w(e: Lanes3, s: f64x4, w: Lanes3) -> Lanes3 {
    Lanes3 {
        x: s * e.x - w.x,
        y: s * e.y - w.y,
        z: s * e.z - w.z,
    }
}

/// The corners of one triangle over the face of the other.
struct CornerFace {
    /// Infinite if the corner's foot is outside of the face.
    square: f64x4,
    u: f64x4,
    v: f64x4,
}

impl CornerFace {
    /// The weights of the face's corners, and of the other triangle's.
    #[inline]
    fn weights(&self, lane: usize) -> ([f64; 3], [f64; 3]) {
        let (u, v) = (self.u.to_array()[lane], self.v.to_array()[lane]);
        let mut corner = [0.0; 3];
        corner[LANE_CORNER[lane]] = 1.0;
        ([1.0 - u - v, u, v], corner)
    }
}

#[inline]
fn corners_to_face(face: &Corners, corners: &Corners) -> CornerFace {
    let (e, f) = (face[1] - face[0], face[2] - face[0]);
    let n = e.cross(f);
    let square = n.length_squared();
    let per = if square > 0.0 { 1.0 / square } else { 0.0 };
    // The dual basis of the two edges within the plane: u = w·g, v = w·h.
    let (g, h) = (per * f.cross(n), per * n.cross(e));
    let w = Lanes3::new(LANE_CORNER.map(|k| corners[k] - face[0]));
    let u = w.dot(Lanes3::splat(g));
    let v = w.dot(Lanes3::splat(h));
    let apart = w.back(u, Lanes3::splat(e)).back(v, Lanes3::splat(f));
    let zero = f64x4::ZERO;
    let inside = u.simd_ge(zero) & v.simd_ge(zero) & (f64x4::ONE - u - v).simd_gt(zero);
    CornerFace {
        square: inside.select(apart.dot(apart), f64x4::splat(f64::INFINITY)),
        u,
        v,
    }
}

/// Returns the least value and its lane.
#[inline(always)]
fn least(x: f64x4) -> (f64, usize) {
    let x = x.to_array();
    let low = if x[1] < x[0] { 1 } else { 0 };
    let high = if x[3] < x[2] { 3 } else { 2 };
    let lane = if x[high] < x[low] { high } else { low };
    (x[lane], lane)
}

#[inline(always)]
fn on_edge(start: usize, t: f64) -> [f64; 3] {
    let mut out = [0.0; 3];
    out[start] = 1.0 - t;
    out[(start + 1) % 3] += t;
    out
}

/// The point with the given weights, which add up to one.
#[inline(always)]
pub(crate) fn at(corners: &Corners, [u, v, w]: [f64; 3]) -> DVec3 {
    u * corners[0] + v * corners[1] + w * corners[2]
}
