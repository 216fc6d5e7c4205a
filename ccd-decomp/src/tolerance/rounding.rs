//! Bounds on rounding that proofs rely on: a smaller value breaks a guarantee.

use ccd_core::glam::DVec3;
use ccd_core::rounding::UNIT_ROUNDOFF_F64;

/// The distance to another shell below which the center of a face is not used to find the nesting of its shell. It is
/// relative to the mesh's size and its distance from the origin. Rounding moves the center off the face by 8
/// [`UNIT_ROUNDOFF_F64`] at most, and the face's normal is accurate to a hundredth even for needles of an aspect of
/// 1e6.
pub(crate) const FACE_CENTER_ROUNDING: f64 = 1e-12;

/// Returns a bound on the rounding error of the test of a point against an [oriented box](crate::search) along an
/// axis. `direction` is the axis, of length about 1. It covers the difference of the point and the box's center, and the
/// sum of the box's half length and its slack, for coordinates up to `reach`, in the same unit.
///
/// With `u` half a unit in the last place, `d` the sum of the direction's coordinates and `m` the reach: a difference
/// is off by `2u m` in every coordinate and its length along the direction by `8u d m`. The half length is at most
/// `2√3 m`, and its sum with the slack and this bound is off by `8u d m`, as `d` is at least 1. That is 16u; 128u are
/// used, plus a term for underflow.
pub(crate) fn box_rounding_bound(direction: DVec3, reach: f64) -> f64 {
    128.0 * UNIT_ROUNDOFF_F64 * direction.abs().element_sum() * reach + f64::MIN_POSITIVE
}

/// Returns a bound on the rounding error of a sum of triple products `a · (b × c)`, in the unit of the products. The
/// vectors are rounded differences of points. `terms` is the number of products, and `size` is the sum of `|a| |b|
/// |c|`. The rounding errors of the additions are summed separately.
///
/// With `u` half a unit in the last place: of the six products of three coordinates each comes from three differences,
/// and is rounded twice and added up four times: a relative error of 9u. Their sizes add up to at most
/// `√3 |a| |b| |c|`: 16u of the size. A compensated sum of `n` terms has a relative error of `u`, and an error of
/// `2 n² u²` of their sizes. The size has a relative error of `(n + 16) u`. 32u are used, plus a term in `n²`.
pub(crate) fn volume_rounding_bound(size: f64, terms: f64) -> f64 {
    (32.0 + 4.0 * terms * (terms * UNIT_ROUNDOFF_F64)) * UNIT_ROUNDOFF_F64 * size
}

/// A bound on the error of the distance from a point to the nearest triangle, in units of half the mesh's diagonal. The
/// rounding error is 1e-15 for well-shaped triangles, and less than a tenth of this for triangles that are just no
/// [needles](MAX_NEEDLE_RATIO).
pub(crate) const DISTANCE_ERROR_BOUND_PER_HALF_DIAGONAL: f64 = 1e-9;

/// Returns a bound on the rounding errors of lengths in the search for a hull's excess: [`DISTANCE_ERROR_BOUND_PER_HALF_DIAGONAL`], and
/// six cuts of a triangle at the sides of a box. Coordinates are up to `farthest`, in the same unit.
///
/// With `u` half a unit in the last place and `m` the farthest coordinate: at each cut the share of the edge has a
/// relative error of `3u`, which moves the point by `2√3 · 3u m`, the edge's direction and the product by `2√3 · u m`
/// each, the sum by `√3 u m`: less than 20u, 120u for six of them. The two dot products of a height above a plane are
/// off by `6√3 u m` each, the center of a box by `√3 u m`. 256u are used.
pub(crate) fn excess_rounding_bound(half_diagonal: f64, farthest: f64) -> f64 {
    DISTANCE_ERROR_BOUND_PER_HALF_DIAGONAL * half_diagonal + 256.0 * UNIT_ROUNDOFF_F64 * farthest
}

/// The ratio of a triangle's height to its longest side below which it counts as a needle. The library's error grows
/// with the inverse: it exceeds [`DISTANCE_ERROR_BOUND_PER_HALF_DIAGONAL`] at 1e-6.
pub(crate) const MAX_NEEDLE_RATIO: f64 = 1e-4;

/// The minimum sine of the angle between two sides of a facet for the facet's plane to be used. The error of the
/// facet's normal is then at most `4 UNIT_ROUNDOFF_F64 / 1e-6`, less than [`DISTANCE_ERROR_BOUND_PER_HALF_DIAGONAL`].
pub(crate) const MIN_CORNER_SINE: f64 = 1e-6;

/// The factor by which a polytope about an ellipsoid is larger than its least facet asks for.
///
/// With `u` half a unit in the last place: corners of length 1 are off by `8u`, and so are heights of facets, whose corners are
/// 0.05 apart, by less than `1e4 u`. Mapping them rounds each coordinate by `3u` of itself, which is `3u` as the ball sees it.
/// 1e-11 is `9e4 u`.
pub(crate) const ELLIPSOID_ENLARGEMENT: f64 = 1.0 + 1e-11;
