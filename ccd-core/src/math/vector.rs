//! Lengths and directions of vectors, without overflow or underflow.
//!
//! A length is the root of a sum of squares. Squares of components below about 1e-154 lose their digits, then vanish;
//! above 1e154 they overflow. A vector divided by such a length is not a unit vector, and a height along it is not a
//! distance. Every proof along an axis uses the functions of this module for the axis.

use super::order::{greater, lesser};
use crate::rounding::{EXTREME_VECTOR_SCALE, SQUARED_LENGTH_RANGE};
use glam::DVec3;

/// Returns the unit vector along `v`; `None` for zero, and for a NaN or infinite component.
///
/// # Guarantee
/// Its length is 1 to within `4u`, for vectors of any length: three squares and their sum (3u,
/// halved by the root), the root and the quotient (1u each).
///
/// ```
/// use ccd_core::{glam::DVec3, vector::unit};
/// let tiny = DVec3::new(3e-320, 4e-320, 0.0);
/// assert!((unit(tiny).unwrap().length() - 1.0).abs() < 1e-15);
/// assert_eq!(unit(DVec3::ZERO), None);
/// ```
#[inline]
pub fn unit(v: DVec3) -> Option<DVec3> {
    let square = v.length_squared();
    if SQUARED_LENGTH_RANGE.contains(&square) {
        Some(v / square.sqrt())
    } else {
        unit_of_extreme_vector(v)
    }
}

#[cold]
fn unit_of_extreme_vector(v: DVec3) -> Option<DVec3> {
    let v = scale_to_normal_range(v).0;
    let length = v.length();
    // False for NaN too.
    (length > 0.0 && length.is_finite()).then(|| v / length)
}

/// Returns the unit vector along `v`, or an arbitrary unit vector if there is none: a support gap along any axis is a
/// bound.
#[inline]
pub(crate) fn unit_or_any(v: DVec3) -> DVec3 {
    unit(v).unwrap_or(DVec3::X)
}

/// Returns the length of a vector of any magnitude.
///
/// # Guarantee
/// Its relative error is at most `4u`; a denormal number is exact to its last bit.
#[inline]
pub fn length(v: DVec3) -> f64 {
    let (v, back) = scale_to_normal_range(v);
    v.length() * back
}

/// Returns the distance of two points: the [length] of their difference.
#[inline]
pub fn distance(a: DVec3, b: DVec3) -> f64 {
    length(b - a)
}

/// Returns a vector of any length perpendicular to two others; zero if they are parallel up to rounding.
///
/// The components of a cross product are products, which vanish for short vectors. Both vectors are
/// therefore scaled to a length near 1 first.
#[inline]
pub fn vector_perpendicular_to_both(a: DVec3, b: DVec3) -> DVec3 {
    scale_to_normal_range(a).0.cross(scale_to_normal_range(b).0)
}

/// Returns the unit normal of a triangle, on the side from which its corners are counterclockwise; `None` if they are
/// on one line.
#[inline]
pub fn normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let across_both = (b - a).cross(c - a);
    let square = across_both.length_squared();
    // Products that underflowed or overflowed leave a square outside of this range.
    if SQUARED_LENGTH_RANGE.contains(&square) {
        Some(across_both / square.sqrt())
    } else {
        unit_of_extreme_vector(vector_perpendicular_to_both(b - a, c - a))
    }
}

/// Scales a vector by a power of two so that its square is in the normal range. Returns the scaled vector and the
/// inverse factor.
#[inline]
fn scale_to_normal_range(v: DVec3) -> (DVec3, f64) {
    let (scale, back) = scale_and_inverse(v.length_squared());
    (v * scale, back)
}

/// Returns the power of two that scales a vector so that its square is in the normal range, and the inverse of that
/// power. `square` is the computed square.
#[inline]
pub(crate) fn scale_and_inverse(square: f64) -> (f64, f64) {
    if square < *SQUARED_LENGTH_RANGE.start() {
        (EXTREME_VECTOR_SCALE, EXTREME_VECTOR_SCALE.recip())
    } else if square > *SQUARED_LENGTH_RANGE.end() {
        (EXTREME_VECTOR_SCALE.recip(), EXTREME_VECTOR_SCALE)
    } else {
        (1.0, 1.0)
    }
}

/// Returns the bits of a point's coordinates, which are the same for equal points: the numbers 0 and −0 are equal.
#[inline]
pub fn position_bits(point: DVec3) -> [u64; 3] {
    point.to_array().map(|x| (x + 0.0).to_bits())
}

/// Returns the lowest and the highest corner of the bounding box of some points; infinite without points.
pub fn bounding_box(points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), p| {
        (lo.min(p), hi.max(p))
    })
}

/// Returns the vector of the lesser coordinates of two vectors.
pub(crate) fn componentwise_min(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(lesser(a.x, b.x), lesser(a.y, b.y), lesser(a.z, b.z))
}

/// Returns the vector of the greater coordinates of two vectors.
pub(crate) fn componentwise_max(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(greater(a.x, b.x), greater(a.y, b.y), greater(a.z, b.z))
}

#[cfg(test)]
mod tests;
