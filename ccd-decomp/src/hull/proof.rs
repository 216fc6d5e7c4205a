//! Exact proofs that polygons are the facets of the hull of points.

use crate::exact::predicates::{Projection, lexicographic, side};
use ccd_core::Loops;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// The reason why polygons are not the facets of the hull.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Refutation {
    /// The polygon of this index is not flat and strictly convex.
    NotConvex(usize),
    /// This edge does not have one polygon on each side, each behind the other's plane.
    Edge(u32, u32),
}

/// Returns the polygons, if they form a closed surface that is convex at every edge.
///
/// They are then the facets of the hull of all points that are in front of none. The incremental hull decides that
/// exactly: each point became a corner or was inside when it was inserted, and the hull only grows.
///
/// # Errors
/// [`Refutation`].
///
/// # Complexity
/// O(n log n) for n polygons.
pub(super) fn prove(points: &[DVec3], polygons: Loops) -> Result<Loops, Refutation> {
    if let Some(bent) = polygons.iter().position(|p| !is_convex(points, p)) {
        return Err(Refutation::NotConvex(bent));
    }
    if let Some((v, w)) = unmatched_edge(points, &polygons) {
        return Err(Refutation::Edge(v, w));
    }
    Ok(polygons)
}

/// Returns whether a loop is flat, turns left at every corner, and goes around once.
fn is_convex(points: &[DVec3], corners: &[u32]) -> bool {
    let n = corners.len();
    let at = |k: usize| points[corners[k % n] as usize];
    if n < 3 {
        return false;
    }
    let plane = plane(points, corners);
    let Some(projection) = Projection::new(plane) else {
        return false;
    };
    if n == 3 {
        return true;
    }
    let flat = (3..n).all(|k| side(plane, at(k)) == Ordering::Equal);
    let left = |k: usize| projection.turn(at(k), at(k + 1), at(k + 2)) == Ordering::Greater;
    // Along any direction, a convex loop goes up once and down once.
    let up = |k: usize| lexicographic(at(k), at(k + 1));
    flat && (0..n).all(left) && (0..n).filter(|&k| up(k) != up(k + 1)).count() == 2
}

fn plane(points: &[DVec3], corners: &[u32]) -> [DVec3; 3] {
    [corners[0], corners[1], corners[2]].map(|v| points[v as usize])
}

/// Returns an edge that does not have one polygon on each side, each behind the other's plane (one implies the other).
/// An empty list counts as such an edge.
fn unmatched_edge(points: &[DVec3], polygons: &Loops) -> Option<(u32, u32)> {
    // Sorting puts the two directions of an edge side by side: the smaller end first, then the direction.
    let mut edges: Vec<(u64, bool, u32)> = Vec::with_capacity(polygons.corners().len());
    for (k, corners) in (0..).zip(polygons.iter()) {
        let next = corners.iter().cycle().skip(1);
        edges.extend(corners.iter().zip(next).map(|(&v, &w)| {
            let (low, high) = (v.min(w), v.max(w));
            (u64::from(low) << 32 | u64::from(high), v > w, k)
        }));
    }
    edges.sort_unstable();
    let ends = |edge: u64| ((edge >> 32) as u32, edge as u32);
    let polygon = |k: u32| polygons.get(k as usize).unwrap_or_default();
    let is_fold = |pair: &[(u64, bool, u32)]| match *pair {
        [(one, false, left), (other, true, right)] if one == other => {
            folds(points, ends(one).into(), polygon(left), polygon(right))
        }
        _ => false,
    };
    if edges.is_empty() {
        return Some((0, 0));
    }
    let twice = |e: &[(u64, bool, u32)]| (e[0].0, e[0].1) == (e[1].0, e[1].1);
    let odd = edges.windows(2).find(|e| twice(e));
    let odd = odd.or_else(|| edges.chunks(2).find(|pair| !is_fold(pair)));
    odd.map(|edges| ends(edges[0].0))
}

/// Returns whether the polygon beyond an edge of a flat polygon continues behind its plane.
fn folds(points: &[DVec3], edge: [u32; 2], polygon: &[u32], beyond: &[u32]) -> bool {
    let plane = plane(points, polygon);
    // The ends are in the plane: the predicate would be slowest for them.
    let others = beyond.iter().filter(|v| !edge.contains(v));
    let mut sides = others.map(|&v| side(plane, points[v as usize]));
    sides.find(|&side| side != Ordering::Equal) == Some(Ordering::Less)
}
