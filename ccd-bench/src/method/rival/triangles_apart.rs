//! Computes the nearest points of two triangles.
//!
//! The rivals' own, four edges at a time: the referee that judges them shares no code with it.

use super::lanes::{Vec3x4, least_lane};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use wide::f64x4;

#[cfg(test)]
mod tests;

/// A triangle, given by its three corners.
pub(super) type Triangle = [DVec3; 3];

/// The nearest points of two triangles; the same point twice if the triangles meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct NearestPoints {
    /// The nearest point on triangle A.
    pub(super) point_on_a: DVec3,
    /// The nearest point on triangle B.
    pub(super) on_b: DVec3,
}

impl NearestPoints {
    /// Returns the vector from the point on A to the point on B.
    pub(super) fn vector_from_a_to_b(&self) -> DVec3 {
        self.on_b - self.point_on_a
    }
}

/// Returns the nearest points of two triangles that are given in one frame.
///
/// # Guarantee
/// Exact except for rounding; triangles without area are segments or points.
///
/// # Complexity
/// Constant: the nearest of the nine pairs of edges and the six pairs of a corner and a face
/// \[PQP99 §4\], with the three features of one triangle at a time.
pub(super) fn nearest_points(a: &Triangle, b: &Triangle) -> NearestPoints {
    let (face_a, face_b) = (TrianglePlane::new(a), TrianglePlane::new(b));
    let (over_a, over_b) = (face_a.scaled_heights(b), face_b.scaled_heights(a));
    // Nothing is above or below the plane of a needle, which has no normal.
    let cut = |face: &TrianglePlane, heights| face.is_needle() || have_both_signs(heights);
    if cut(&face_a, over_a) && cut(&face_b, over_b) {
        let meeting =
            piercing_point(&face_a, over_a, b).or_else(|| piercing_point(&face_b, over_b, a));
        if let Some(point) = meeting {
            return NearestPoints {
                point_on_a: point,
                on_b: point,
            };
        }
    }
    let (mut squared, mut best) = nearest_edge_points(a, b);
    if let Some((less, foot, k)) = face_a
        .nearest_projecting_point(over_a, b)
        .filter(|f| f.0 < squared)
    {
        squared = less;
        best = NearestPoints {
            point_on_a: foot,
            on_b: b[k],
        };
    }
    if let Some((_, foot, k)) = face_b
        .nearest_projecting_point(over_b, a)
        .filter(|f| f.0 < squared)
    {
        best = NearestPoints {
            point_on_a: a[k],
            on_b: foot,
        };
    }
    best
}

/// Returns the nearest points of the triangles' edges, and their squared distance.
#[inline(always)]
fn nearest_edge_points(a: &Triangle, b: &Triangle) -> (f64, NearestPoints) {
    let (from_b, along_b) = (pack_vectors(b), pack_vectors(&edges(b)));
    let long_b = along_b.dot_each(along_b);
    let scale_b = reciprocal_or_zero(long_b);
    let edges_a = edges(a);
    let (zero, one) = (f64x4::splat(0.0), f64x4::splat(1.0));
    let mut squared = f64x4::splat(f64::INFINITY);
    let [mut s_best, mut t_best, mut edge] = [zero; 3];
    for (i, along) in edges_a.into_iter().enumerate() {
        // The points are at s on A's edge and at t on B's edges.
        let apart = from_b.minus(Vec3x4::splat(a[i]));
        let long_a = f64x4::splat(along.length_squared());
        let both = along_b.dot(along);
        let (ahead_a, ahead_b) = (apart.dot(along), apart.dot_each(along_b));
        // By the sine, not by 1 − cos²: edges that are nearly parallel still cross somewhere.
        let sine = Vec3x4::splat(along).cross_each(along_b);
        let sine_squared = sine.dot_each(sine);
        let s = apart.dot_each(along_b.cross_each(sine)) / sine_squared;
        let skew = sine_squared.simd_gt(zero);
        let s = skew.select(s.fast_clamp(zero, one), zero);
        let t = (both.mul_sub(s, ahead_b) * scale_b).fast_clamp(zero, one);
        let s = (both.mul_add(t, ahead_a) * reciprocal_or_zero(long_a)).fast_clamp(zero, one);
        let vectors = apart
            .plus_scaled_each(t, along_b)
            .minus(Vec3x4::splat(DVec3::ZERO).plus_scaled(s, along));
        let found = vectors.dot_each(vectors);
        let nearer = found.simd_lt(squared);
        squared = squared.fast_min(found);
        s_best = nearer.select(s, s_best);
        t_best = nearer.select(t, t_best);
        edge = nearer.select(f64x4::splat(i as f64), edge);
    }
    let (k, squared) = least_lane(squared);
    let (i, s, t) = (
        edge.to_array()[k],
        s_best.to_array()[k],
        t_best.to_array()[k],
    );
    let (i, k) = (i as usize, k % 3);
    let nearest = NearestPoints {
        point_on_a: a[i] + s * edges_a[i],
        on_b: b[k] + t * edges(b)[k],
    };
    (squared, nearest)
}

/// The least ratio of a triangle's height to its longest edge; flatter ones count as needles. Below it, the edges
/// represent the triangle, since its normal is mostly rounding.
const MIN_HEIGHT_RATIO: f64 = 1e-12;

/// A triangle with its normal, from which the heights of points above the triangle's plane are computed.
struct TrianglePlane {
    corners: Triangle,
    /// The normal, not of unit length; zero for a needle.
    normal: DVec3,
    /// 1 / |normal|²; zero for a needle.
    inverse_squared_normal: f64,
}

impl TrianglePlane {
    #[inline(always)]
    fn new(corners: &Triangle) -> Self {
        let [u, v, w] = edges(corners);
        let normal = u.cross(v);
        let squared = normal.length_squared();
        let longest = [u, v, w]
            .map(DVec3::length_squared)
            .iter()
            .copied()
            .fold(0.0, greater);
        let solid = squared > (MIN_HEIGHT_RATIO * longest) * (MIN_HEIGHT_RATIO * longest);
        TrianglePlane {
            corners: *corners,
            normal: if solid { normal } else { DVec3::ZERO },
            inverse_squared_normal: if solid { 1.0 / squared } else { 0.0 },
        }
    }

    fn is_needle(&self) -> bool {
        !(self.inverse_squared_normal > 0.0)
    }

    /// Returns the heights of points above the triangle's plane, times |normal|; all zero for a needle.
    #[inline(always)]
    fn scaled_heights(&self, points: &Triangle) -> f64x4 {
        pack_vectors(points)
            .minus(Vec3x4::splat(self.corners[0]))
            .dot(self.normal)
    }

    /// Returns a mask of the points whose perpendicular feet lie in the triangle.
    #[inline(always)]
    fn inside_mask(&self, points: Vec3x4) -> f64x4 {
        let [u, v, w] = edges(&self.corners).map(|edge| self.normal.cross(edge));
        let [a, b, c] = self.corners;
        let zero = f64x4::splat(0.0);
        let inside = |corner, inward| {
            points
                .minus(Vec3x4::splat(corner))
                .dot(inward)
                .simd_ge(zero)
        };
        inside(a, u) & inside(b, v) & inside(c, w)
    }

    /// Returns the squared height, the foot and the index of the point nearest to the plane, among those that project
    /// into the triangle.
    #[inline(always)]
    fn nearest_projecting_point(
        &self,
        heights: f64x4,
        points: &Triangle,
    ) -> Option<(f64, DVec3, usize)> {
        if self.is_needle() {
            return None;
        }
        let squared = heights * heights * f64x4::splat(self.inverse_squared_normal);
        let far = f64x4::splat(f64::INFINITY);
        let (k, squared) = least_lane(self.inside_mask(pack_vectors(points)).select(squared, far));
        let height = heights.to_array()[k];
        let k = k % 3;
        let foot = points[k] - height * self.inverse_squared_normal * self.normal;
        (squared < f64::INFINITY).then_some((squared, foot, k))
    }
}

/// Returns the point where an edge of the triangle `corners` passes through `face`, given the heights of the corners.
fn piercing_point(face: &TrianglePlane, heights: f64x4, corners: &Triangle) -> Option<DVec3> {
    let [h, i, j, _] = heights.to_array();
    let next = f64x4::new([i, j, h, i]);
    let fraction = heights / (heights - next);
    let points = pack_vectors(corners).plus_scaled_each(fraction, pack_vectors(&edges(corners)));
    let crosses = (heights * next).simd_lt(f64x4::splat(0.0));
    let hits = (crosses & face.inside_mask(points)).to_bitmask();
    (hits != 0).then(|| points.lane(hits.trailing_zeros() as usize))
}

/// Returns true if some heights are positive and others negative.
#[inline(always)]
fn have_both_signs(heights: f64x4) -> bool {
    let zero = f64x4::splat(0.0);
    heights.simd_lt(zero).any() && heights.simd_gt(zero).any()
}

#[inline(always)]
fn edges([a, b, c]: &Triangle) -> Triangle {
    [*b - *a, *c - *b, *a - *c]
}

/// Packs three vectors into four lanes, the first one twice.
#[inline(always)]
fn pack_vectors([a, b, c]: &Triangle) -> Vec3x4 {
    Vec3x4::new([*a, *b, *c, *a])
}

/// Returns the reciprocal in each lane, or zero where a lane is zero. The nearest point of an edge without length is
/// then its start.
#[inline(always)]
fn reciprocal_or_zero(x: f64x4) -> f64x4 {
    let zero = f64x4::splat(0.0);
    x.simd_gt(zero).select(f64x4::splat(1.0) / x, zero)
}
