//! The side of a plane or line on which a point lies: exactly, by the crate `robust` `[SHE97]`.

use ccd_core::glam::DVec3;
use ccd_core::limits::LEAST_COORDINATE;
use ccd_core::order::greater;
use robust::{Coord, Coord3D, orient2d, orient3d};
use std::cmp::Ordering;

/// Finds the first point with a coordinate [too near to 0](LEAST_COORDINATE) for the predicates to be exact.
pub(crate) fn too_fine(points: &[DVec3]) -> Option<usize> {
    let fine = |x: f64| x != 0.0 && x.abs() < LEAST_COORDINATE;
    points
        .iter()
        .position(|p| p.to_array().into_iter().any(fine))
}

/// The side of a triangle's plane on which a point lies: `Greater` in front, where the triangle is seen
/// counter-clockwise, `Less` behind, `Equal` in the plane, or when the triangle has no area.
#[inline]
pub(crate) fn side(triangle: [DVec3; 3], point: DVec3) -> Ordering {
    let [p, q, r] = triangle;
    let level = p.cmpeq(q) & p.cmpeq(r) & p.cmpeq(point);
    if level.any() {
        // All lie in a plane across a coordinate axis, which the predicate would take longest to compute.
        return Ordering::Equal;
    }
    // Shewchuk's determinant is positive below.
    sign(-orient3d(coord3(p), coord3(q), coord3(r), coord3(point)))
}

/// The [side] for points of a list, by their numbers. A corner of the triangle is in its plane without a
/// computation, which would be the predicate's longest.
#[inline]
pub(crate) fn side_of(points: &[DVec3], triangle: [u32; 3], point: u32) -> Ordering {
    if triangle.contains(&point) {
        return Ordering::Equal;
    }
    let [a, b, c] = triangle;
    let corners = [points[a as usize], points[b as usize], points[c as usize]];
    side(corners, points[point as usize])
}

/// A projection of a triangle to a coordinate plane that keeps an area, and the triangle's orientation there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Projection {
    drop: usize,
    turned: bool,
}

impl Projection {
    /// Finds a projection; none for a triangle without area.
    pub(crate) fn of(triangle: [DVec3; 3]) -> Option<Self> {
        (0..3).find_map(|drop| {
            let [a, b, c] = triangle.map(|p| coord2(p, drop));
            match sign(orient2d(a, b, c)) {
                Ordering::Equal => None,
                turn => Some(Projection {
                    drop,
                    turned: turn == Ordering::Less,
                }),
            }
        })
    }

    /// The side of a line in the triangle's plane on which a point of the plane lies: `Greater` to the left of
    /// the direction from `a` to `b`, seen from the triangle's front.
    #[inline]
    pub(crate) fn turn(self, a: DVec3, b: DVec3, point: DVec3) -> Ordering {
        let (a, b, point) = (
            coord2(a, self.drop),
            coord2(b, self.drop),
            coord2(point, self.drop),
        );
        match self.turned {
            true => sign(orient2d(b, a, point)),
            false => sign(orient2d(a, b, point)),
        }
    }
}

/// The side of a line on which a point lies, seen against a coordinate axis: `Greater` to the left of the
/// direction from `a` to `b`.
pub(crate) fn turn_along(axis: usize, [a, b]: [DVec3; 2], point: DVec3) -> Ordering {
    let [a, b, point] = [a, b, point].map(|p| coord2(p, axis));
    sign(orient2d(a, b, point))
}

/// Whether a triangle has no area.
pub(crate) fn is_degenerate(triangle: [DVec3; 3]) -> bool {
    Projection::of(triangle).is_none()
}

/// Whether a triangle has no area, with coordinates however near to 0. Each axis is first scaled by a power of
/// two until its largest coordinate is about 1, which does not change the answer. Exact, unless coordinates
/// along one axis differ by a factor of more than 1e90.
pub(crate) fn is_without_area(triangle: [DVec3; 3]) -> bool {
    let [a, b, c] = triangle.map(DVec3::abs);
    let scale = DVec3::from_array(a.max(b).max(c).to_array().map(scale_to_one));
    is_degenerate(triangle.map(|p| p * scale))
}

/// The power of two that takes a small number to about 1; 1 for any other number.
fn scale_to_one(x: f64) -> f64 {
    const EXPONENT: u64 = f64::INFINITY.to_bits();
    match x > 0.0 && x < 1.0 {
        true => greater(f64::MIN_POSITIVE, f64::from_bits(x.to_bits() & EXPONENT)).recip(),
        false => 1.0,
    }
}

/// Compares points by x, then y, then z. On a plane or a line this is the order along some direction.
pub(crate) fn lexicographic(p: DVec3, q: DVec3) -> Ordering {
    let by = |x: f64, y: f64| x.partial_cmp(&y).unwrap_or(Ordering::Equal);
    by(p.x, q.x).then(by(p.y, q.y)).then(by(p.z, q.z))
}

#[inline]
fn sign(determinant: f64) -> Ordering {
    // Coordinates are finite and within bounds, so that the determinant is not NaN.
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
fn coord2(p: DVec3, drop: usize) -> Coord<f64> {
    let (x, y) = match drop {
        0 => (p.y, p.z),
        1 => (p.z, p.x),
        _ => (p.x, p.y),
    };
    Coord { x, y }
}

#[cfg(test)]
mod tests;
