//! Separating axes of pieces that are so near that the vector between their nearest points is mostly rounding.

use super::nearest::Corners;
use crate::lanes::{FourVectors, reciprocal_or_zero, splat};
use ccd_core::fearless_simd::{Simd, f64x4, prelude::*};
use ccd_core::glam::DVec3;
use ccd_core::vector::unit;

/// Returns the unit vector with the largest gap of the candidates for the separating axis of two triangles, and that gap.
/// The nearest points of the triangles differ by about `w`. Without a candidate the vector is zero, and the gap −∞.
///
/// The difference `w` of the nearest points is rounded, so that it may leave the cone of normals that it belongs to.
/// The borders of that cone are also candidates: for a vertex and an edge, `w` made perpendicular to the edge; for two
/// edges, their cross product; for a face, its normal; and in one plane, the normals of the edges within it.
#[inline(always)]
pub(crate) fn best_separating_axis<L: Simd>(
    level: L,
    p: &Corners,
    q: &Corners,
    w: DVec3,
) -> (DVec3, f64) {
    let (edges_p, edges_q) = (edges(p), edges(q));
    let (normal_p, normal_q) = (normal(&edges_p), normal(&edges_q));
    let lanes_q = pack_four_lanes(level, edges_q, DVec3::ZERO);
    // Nearly parallel edges have a cross product that rounding tilts along them.
    let cross = |e: DVec3| {
        let e = FourVectors::splat(level, e);
        let n = e.cross(lanes_q);
        n.perpendicular_part(e).perpendicular_part(lanes_q)
    };
    let w = FourVectors::splat(level, w);
    let mut directions = [
        cross(edges_p[0]),
        cross(edges_p[1]),
        cross(edges_p[2]),
        w.perpendicular_part(pack_four_lanes(level, edges_p, DVec3::ZERO)),
        w.perpendicular_part(lanes_q),
        pack_four_lanes(level, edges_p.map(|e| e.cross(normal_p)), normal_p),
        pack_four_lanes(level, edges_q.map(|e| e.cross(normal_q)), normal_q),
        axes_of_longest_edge(level, &edges_p, &edges_q),
    ];
    // The support gaps along the unit vectors of the directions; −∞ for a zero direction.
    let mut gaps = [splat(level, 0.0); 8];
    for (n, gap) in directions.iter_mut().zip(&mut gaps) {
        (*n, *gap) = orient_to_larger_gap(p, q, *n);
    }
    let gap = |k: usize| gaps[k / 4][k % 4];
    let best = (0..4 * gaps.len()).fold(0, |best, k| if gap(k) > gap(best) { k } else { best });
    let direction = unit(directions[best / 4].lane(best % 4));
    (direction.unwrap_or(DVec3::ZERO), gap(best))
}

/// Orients each direction towards the larger support gap, and returns the gaps along the unit vectors.
#[inline(always)]
fn orient_to_larger_gap<L: Simd>(
    p: &Corners,
    q: &Corners,
    n: FourVectors<L>,
) -> (FourVectors<L>, f64x4<L>) {
    let level = n.simd_level();
    let [a, b, c] = p.map(|x| n.dot(FourVectors::splat(level, x)));
    let [d, e, f] = q.map(|y| n.dot(FourVectors::splat(level, y)));
    let ahead = d.min(e).min(f) - a.max(b).max(c);
    let behind = a.min(b).min(c) - d.max(e).max(f);
    let flip = behind.simd_gt(ahead);
    let length2 = n.dot(n);
    let gap = ahead.max(behind) * reciprocal_or_zero(length2.sqrt());
    let sign = flip.select(splat(level, -1.0), splat(level, 1.0));
    let turned = FourVectors {
        x: n.x * sign,
        y: n.y * sign,
        z: n.z * sign,
    };
    let none = splat(level, f64::NEG_INFINITY);
    (turned, length2.simd_gt(0.0).select(gap, none))
}

fn edges([a, b, c]: &Corners) -> [DVec3; 3] {
    [b - a, c - b, a - c]
}

/// Returns the normal of a triangle, made perpendicular to its longest edge. For a needle, the remaining error is a
/// rotation about that edge.
fn normal(edges: &[DVec3; 3]) -> DVec3 {
    let n = edges[0].cross(edges[1]);
    let long = longest_edge(edges);
    match long.length_squared() {
        square if square > 0.0 => n - n.dot(long) / square * long,
        _ => n,
    }
}

/// Returns axes along and perpendicular to the longest edge of both triangles. They serve for segments on one line and
/// for points.
#[inline(always)]
fn axes_of_longest_edge<L: Simd>(
    level: L,
    edges_p: &[DVec3; 3],
    edges_q: &[DVec3; 3],
) -> FourVectors<L> {
    let edge = longest_edge(&[longest_edge(edges_p), longest_edge(edges_q)]);
    let along = unit(edge).unwrap_or(DVec3::X);
    let (across, other) = along.any_orthonormal_pair();
    pack_four_lanes(level, [along, across, other], DVec3::ZERO)
}

fn longest_edge(edges: &[DVec3]) -> DVec3 {
    edges.iter().fold(DVec3::ZERO, |best, &e| {
        if e.length_squared() > best.length_squared() {
            e
        } else {
            best
        }
    })
}

#[inline(always)]
fn pack_four_lanes<L: Simd>(level: L, [a, b, c]: [DVec3; 3], d: DVec3) -> FourVectors<L> {
    FourVectors::new(level, [a, b, c, d])
}
