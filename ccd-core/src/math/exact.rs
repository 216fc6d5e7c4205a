//! Exact geometric predicates: on which side of a plane or a line a point is. The crate `robust` computes them
//! `[SHE97]`.
//!
//! One convention holds: `Greater` is in front of a triangle, where its corners are seen counterclockwise, and to the
//! left of a line.

use crate::limits::LEAST_NONZERO_COORDINATE;
use glam::DVec3;
use robust::{Coord, Coord3D, orient2d, orient3d};
use std::cmp::Ordering;

/// Returns on which side of a triangle's plane a point is: `Greater` in front, `Less` behind, `Equal` in the plane and
/// for a triangle without area.
///
/// # Guarantee
/// Exact, unless a coordinate is [too fine](first_underflow_prone_point_index).
///
/// ```
/// use ccd_core::{exact, glam::DVec3};
/// let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
/// assert!(exact::side_of_plane(triangle, 1e-80 * DVec3::Z).is_gt());
/// assert!(exact::side_of_plane(triangle, DVec3::ONE - DVec3::Z).is_eq());
/// ```
#[inline]
pub fn side_of_plane(triangle: [DVec3; 3], point: DVec3) -> Ordering {
    let [p, q, r] = triangle;
    let level = p.cmpeq(q) & p.cmpeq(r) & p.cmpeq(point);
    if level.any() {
        // The points are in a plane across a coordinate axis. The predicate would take its longest computation here.
        return Ordering::Equal;
    }
    // Shewchuk's determinant is positive behind.
    sign(-orient3d(coord3(p), coord3(q), coord3(r), coord3(point)))
}

/// Returns on which side of the line from `a` to `b` a point is, seen from the positive end of a coordinate axis.
/// `Greater` is to the left.
///
/// # Guarantee
/// Like [`side_of_plane`].
#[inline]
pub fn side_of_line_along(axis: usize, [a, b]: [DVec3; 2], point: DVec3) -> Ordering {
    let [a, b, point] = [a, b, point].map(|p| projected_coord2(p, axis));
    sign(orient2d(a, b, point))
}

/// Returns whether the corners of a triangle are on one line.
///
/// # Guarantee
/// Like [`side_of_plane`].
pub fn is_degenerate([a, b, c]: [DVec3; 3]) -> bool {
    (0..3).all(|axis| side_of_line_along(axis, [a, b], c).is_eq())
}

/// Returns whether the ray from `origin` through `target` meets exactly one triangle, and no edge. The origin has to be
/// [behind](side_of_plane) all triangles.
///
/// # Guarantee
/// Like [`side_of_plane`].
pub fn ray_meets_one_triangle(
    triangles: impl IntoIterator<Item = [DVec3; 3]>,
    origin: DVec3,
    target: DVec3,
) -> bool {
    let mut met = 0;
    for [a, b, c] in triangles {
        let sides = [[a, b], [b, c], [c, a]];
        let within = sides.map(|[from, to]| side_of_plane([origin, from, to], target));
        if within.into_iter().all(Ordering::is_gt) {
            met += 1;
        } else if !within.into_iter().any(Ordering::is_lt) {
            // The ray meets an edge, and the number of triangles is unknown.
            return false;
        }
    }
    met == 1
}

/// Returns the index of the first point with a coordinate that is [too near to 0](LEAST_NONZERO_COORDINATE) for exact
/// predicates.
pub fn first_underflow_prone_point_index(points: &[DVec3]) -> Option<usize> {
    let fine = |x: f64| x != 0.0 && x.abs() < LEAST_NONZERO_COORDINATE;
    points
        .iter()
        .position(|p| p.to_array().into_iter().any(fine))
}

#[inline]
fn sign(determinant: f64) -> Ordering {
    // Coordinates are finite and within bounds, so the determinant is not NaN.
    determinant.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

#[inline]
fn coord3(p: DVec3) -> Coord3D<f64> {
    Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    }
}

#[inline]
fn projected_coord2(p: DVec3, axis: usize) -> Coord<f64> {
    let (x, y) = match axis {
        0 => (p.y, p.z),
        1 => (p.z, p.x),
        _ => (p.x, p.y),
    };
    Coord { x, y }
}

#[cfg(test)]
mod tests;
