//! The bounds of rounding errors that proofs rely on, each with its unit and its derivation. A wrong bound breaks the
//! guarantee. Numbers that only cost time are in `tuning.rs`.
//!
//! `u` is half a unit in the last place of 1: [`UNIT_ROUNDOFF_F64`] in f64, `UNIT_ROUNDOFF_F32` in f32. An operation
//! rounds with a relative error of at most `u`. The counts below add up the worst error of every operation. Tests
//! compare each allowance with exact references, in the worst cases that a search finds. `docs/allowances.md` says how
//! tight each allowance is.

use glam::DVec3;

/// The relative rounding error of one operation in f64.
pub const UNIT_ROUNDOFF_F64: f64 = f64::EPSILON / 2.0;

/// The relative rounding error of one operation in f32.
pub(crate) const UNIT_ROUNDOFF_F32: f32 = f32::EPSILON / 2.0;

/// The relative amount by which a skipped pair of pieces may be nearer than the nearest measured pair. Bounds of nodes
/// are rounded by at most this share ([`FREE_TIME_FACTOR_F32`]). With this allowance, one measured pair suffices if
/// many pairs share a corner, or lie in two planes.
pub(crate) const SKIPPED_PAIR_ALLOWANCE: f64 = 1.0 / 65536.0;

/// The range of squared lengths that are computed with a relative error of a few [`UNIT_ROUNDOFF_F64`]. A component
/// whose own square underflows, below 2.2e-308, is negligible in this range.
pub(crate) const SQUARED_LENGTH_RANGE: std::ops::RangeInclusive<f64> = 1e-200..=1e200;

/// The power of two, 2⁷⁰⁰ = 5.3e210, by which vectors are scaled up or down if their squared lengths are outside of
/// [`SQUARED_LENGTH_RANGE`].
///
/// It takes the least number, 4.9e-324, to 2.6e-113, whose square is exact enough, and 1e-100 to
/// 5.3e110. Its inverse takes the greatest, 1.8e308, to 3.4e97, and 1e100 to 1.9e-111.
pub(crate) const EXTREME_VECTOR_SCALE: f64 = f64::from_bits((1023 + 700) << 52);

/// Returns a bound of the rounding error of distances computed in f64: by how much a support gap or the distance of two
/// witnesses may differ from the exact value. The exact distance is that of the bodies as posed: the given points,
/// poses, centers and velocities, or end poses.
///
/// All numbers are in units of `u`. The error of a matrix is the largest displacement of a unit
/// vector. A point `x` of a body is placed at `R(s)(x − c) + C(s)`, with `R = cos·A + sin·B + C`:
/// - the given quaternion is normalised with an error of 2 in direction, which turns by 4, and of
///   4.5 in length, which scales by up to 18; its matrix is evaluated with an error of 9;
/// - the axis of rotation is off by 4.5, so that `C` is off by 15, `B` by 8, and their share in `R`
///   by 31; sine and cosine add 3, the angle `ω s` adds `5ω`, the four operations of an entry add
///   6;
/// - `R x`, `R c` and the sums add 7 of `|x|` and of `|c|` each, and 6 of the center's
///   displacement;
/// - another rotation leads into A's frame; it differs from the inverse of A's by at most 67, apart
///   from an error that only turns A; its products and sums add 12, of the displacement and of both
///   bodies;
/// - a support value `n·x` with a rounded unit axis adds 4 of `|x|`, and so does a distance;
///   heights along a fixed axis, of which only differences are used, add 16; a support point found
///   by climbing edges may be lower than the farthest one by two heights, `2 · 4 |n|₁ |x|`, which
///   is 14 ([`HEIGHT_ERROR_F64`]).
///
/// Pairs of nodes see one body from the other at once (`motion/relative.rs`). If at most one of the
/// two turns:
/// - products of the three parts of one rotation with the other rotation add 16 in place of 9; the
///   rotation that does not turn saves the 40 of axis, sine, cosine and sums;
/// - the parts that turn the way add 9 in place of 6, and 2 for the product with `s` and its sum.
///
/// That is 33 less of both bodies, and 5 more of the displacement, whose heights, 8, are f32 there.
///
/// Velocities may be derived from poses at both ends:
/// - the displacement `(T₁ − T₀) + (R₁ − R₀) c` adds 4 of its length, and 46 of `|c|`;
/// - the turn adds 12 of a quaternion, which is 45 as an angle, and 9 of its size, which is at most
///   π: 73.
///
/// The sum is at most `300 + 5ω` of a body's span, which counts `|c|` twice, and 96 of `way`, the distance of the
/// centers at the start and along their travel. If neither body turns, the 40 of axis, sine, cosine and sums fall away
/// twice, in `R` and in the rotation into A's frame, and so do 28 of the turn (a turn between poses may be lost in
/// rounding): 192 of the 300 are left, and 56 of the 96. The constant term covers coordinates so small that their
/// squares underflow: a length is then off by 3e-162, squared rates may multiply that by 1e12, and 1e-130 is far above.
/// Without this allowance a touching pair could be certified apart.
pub(crate) fn distance_rounding(spans: [f64; 2], turns: [f64; 2], way: f64) -> f64 {
    let [of_span, of_way] = match turns {
        [0.0, 0.0] => [192.0, 56.0],
        _ => [300.0, 96.0],
    };
    let body = |k: usize| (of_span + 5.0 * turns[k]) * spans[k];
    UNIT_ROUNDOFF_F64 * (body(0) + body(1) + of_way * way) + UNDERFLOW_ERROR_BOUND
}

/// Returns the contribution of one body to [`distance_rounding`], for any motion of the other body. The sum of the
/// shares of two bodies, with the ways of their centers from the world's origin, is no less than the rounding of their
/// distance.
pub(crate) fn body_distance_rounding(span: f64, turn: f64, way: f64) -> f64 {
    UNIT_ROUNDOFF_F64 * ((300.0 + 5.0 * turn) * span + 96.0 * way) + UNDERFLOW_ERROR_BOUND
}

/// Returns the contribution of a margin to [`distance_rounding`]. The margin counts as a part of `way`.
pub(crate) fn margin_rounding(margin: f64) -> f64 {
    96.0 * UNIT_ROUNDOFF_F64 * margin
}

/// The least rotation during a query, in radians, with which a body counts as turning. A lesser one displaces a point by
/// less than 1e-100 of its distance from the center, far below [`UNIT_ROUNDOFF_F64`] of it.
///
/// A part of a path turns by its share of the rotation. That must not underflow, as the other coefficients do not: it
/// stays above 1e-300 for shares above 1e-200.
pub(crate) const LEAST_ROTATION: f64 = 1e-100;

/// The relative error of a motion's pose that is computed for a time other than its start. It is relative to the
/// lengths of its position, its center and its travel; as an angle, it is relative to a radian more than its rotation.
///
/// In units of `u`: the angle is off by 1 of the turn, its sine and cosine by 2, the product of two
/// quaternions by 6, and normalising by 4: an angle of twice that, 24 and 2 of the turn. Turning the center
/// takes 18 of it, twice, and the sums 3 of all lengths: 39. As much again is left for the rounding of the
/// pose that it is computed from: 80 are taken.
pub const RETIMED_POSE_ERROR_F64: f64 = 80.0 * UNIT_ROUNDOFF_F64;

/// Returns a bound of the error of one body's positions in a part of its path, such as one of many periods; it is added
/// to [`distance_rounding`]. It also bounds the error of bounds that are taken over from one period to others.
///
/// In units of `u`, of a point at `reach` from the center, with a turn of `ω` over the whole path:
/// - sine and cosine of the angle at which the part begins add 3, their products and sums 6, that angle `ω`, and the
///   product of rate and time `2ω`;
/// - the number of turns in a period is off by `4ω` over all periods, and by `4ω` more since the rate is;
/// - the time of a contact is rounded down by up to 17 of the part's, see [`RATE_ERROR_F64`]: `17ω`.
///
/// That is `9 + 28ω`. The center begins with an error of 4 of its place and of its travel; the time takes 17 of the
/// latter, products 2, and the difference of two velocities 4: 27 of this `way`. 32 are taken of each.
pub(crate) fn position_rounding(reach: f64, turn: f64, way: f64) -> f64 {
    32.0 * UNIT_ROUNDOFF_F64 * ((1.0 + turn) * reach + way)
}

/// A bound of the absolute error of lengths whose squares underflow, in the scene's unit of length; see
/// [`distance_rounding`].
pub(crate) const UNDERFLOW_ERROR_BOUND: f64 = 1e-130;

/// Returns the least tolerance that can be certified if distances are off by up to `rounding`.
///
/// A pair is in contact when its upper bound is within the tolerance, and advances while its lower
/// bound exceeds half of it. The two bounds differ by up to `2 × rounding`, which leaves `tolerance/2 − 2
/// × rounding` to advance by. Here that is twice the rounding.
pub(crate) fn least_tolerance(rounding: f64) -> f64 {
    8.0 * rounding
}

/// The error of a support gap between two nodes computed in f32, relative to the distance of the unsplit node from the
/// origin of the split node's group.
///
/// In units of `u = 2⁻²⁴`: the distance is rounded once (1), the child's center subtracted (1),
/// projected by three operations (3), the reaches subtracted (2), and the gap divided by the axis's
/// length: a root and a quotient (3), and a product (1). That is 11u; 12u are taken.
pub(crate) const GAP_ERROR_PER_DISTANCE_F32: f32 = 12.0 * UNIT_ROUNDOFF_F32;

/// The error of a support gap between two nodes computed in f32, relative to the radii of the split node's group and of
/// the unsplit node.
///
/// A box's half sizes are measured along axes rounded to f32, which are orthogonal to 2u (3.5u of
/// its radius). Three products with three half sizes, each projected by three operations, add `√3
/// (3 + 3)u`. That is 14u. On the split side, the vector to a child adds 6u. The other node's axes are rotated by a
/// matrix rounded once, with five operations, which adds `√3 · 7u`: 26u.
///
/// Normals count as unit vectors. The other node's normal is rounded once and rotated (8u), a triangle's is divided by
/// its length (a square in three operations, root, quotient and product: 5u). Half sizes and radii are off by that
/// share: 28u of the split side, 31u of the other one; 32u are taken. Triangles need less.
pub(crate) const GAP_ERROR_PER_RADIUS_F32: f32 = 32.0 * UNIT_ROUNDOFF_F32;

/// The error of a rate of approach computed in f32, relative to the largest speed of a point that the rate is computed
/// from.
///
/// Velocities, arms and angular velocities are rounded once (1u each), crossed (3u), rotated with the box (9u)
/// and projected (4u). A rate is therefore off by at most 32u = 1.9e-6 of the largest speed.
pub(crate) const RATE_ERROR_F32: f32 = 2e-6;

/// The share of a node's distance from the origin of the split node's group that is added to its distance from the
/// center of rotation, when the largest speed is computed. That vector, the arm, is the difference of two positions, a
/// node's and that of its body's center of rotation, each rounded by 1u. The share is 4u of the 33u of
/// [`RATE_ERROR_F32`].
pub(crate) const ARM_INCREASE_PER_DISTANCE: f64 = 1.0 / 8.0;

/// The factor that lowers a free time computed in f32, to allow for the rounding of the computation from gap and rate.
///
/// Square, product, sum, root, sum and quotient: at most 8u; 32u are taken.
pub(crate) const FREE_TIME_FACTOR_F32: f32 = 1.0 - 32.0 * UNIT_ROUNDOFF_F32;

/// The factor that raises a second derivative computed in f32, to allow for its rounding. It covers two lengths of
/// vectors whose components are off by up to `8u` each.
pub(crate) const SECOND_DERIVATIVE_FACTOR_F32: f32 = 1.0 + 64.0 * UNIT_ROUNDOFF_F32;

/// The error of `|n × ω|` in f32, in units of `|ω|`: both vectors are rounded (1u each) and crossed (3u). For parallel
/// vectors the computed product is nothing but this error.
pub(crate) const CROSS_PRODUCT_ERROR_F32: f32 = 8.0 * UNIT_ROUNDOFF_F32;

/// The least length of a vector that is used as an axis in f32. Above it, squares that underflow, each by at most
/// 7e-46, are less than `u` of their sum; below 1e-22 they would leave a vector that is off by a fifth. Half sizes'
/// products with it that underflow are less than 1e-27 of a unit vector's. Nothing is lost: shorter vectors cross gaps
/// below [`LEAST_GAP_F32`].
pub(crate) const LEAST_AXIS_LENGTH_F32: f32 = 1e-18;

/// The least gap for which a free time is computed in f32, in the scene's unit of length; smaller gaps count as closed.
/// Above it, a second derivative whose product with the gap underflows (1.2e-38) takes less than 1e-8 of the gap in the
/// whole duration.
pub(crate) const LEAST_GAP_F32: f32 = 1e-15;

/// The least value that f32 code uses as an upper bound of a path's second derivative, in units of length over time
/// squared. Smaller bounds are raised, so that a division by the bound stays finite for a straight path. A raised bound
/// is still an upper bound.
pub(crate) const LEAST_SECOND_DERIVATIVE_F32: f32 = 1e-30;

/// The relative error of speeds and free times computed in f64: the axis is off by 2u, the arm by 5u, products and sums
/// add 7u. The quotient and the root of a free time need less.
pub(crate) const RATE_ERROR_F64: f64 = 16.0 * UNIT_ROUNDOFF_F64;

/// Returns the relative error of heights and rates of one body's points along an axis that turns with the other body,
/// computed in f64. It comes in addition to the error of their positions. Heights are relative to the farthest distance
/// from the turning body's center, and rates to the largest speed past it. `turns` is the sum of both bodies'
/// rotations.
///
/// In units of `u`: an angle is off by `4ω` (its rate by 3, a product adds 1), sine and cosine by 4
/// more, and the turned axis by 8 more (3 terms, and 2 of its own). Turning it with its body and
/// back with the other one adds `24 + 4 turns`, the change to that body's frame 4, the displacement
/// 6, and the products with the axis and their sum 5. Differences of two heights take twice as
/// much, at most `78 + 8 turns`; `96 + 8 turns` is taken.
pub(crate) fn turning_axis_rounding(turns: f64) -> f64 {
    UNIT_ROUNDOFF_F64 * (96.0 + 8.0 * turns)
}

/// The decrease of a pair's distance from which on the pair counts as approaching, in units of the distance's rounding.
/// It is for pairs that are in contact at the start, and is measured from the distance at the start. Four units cover
/// the rounding of both distances, and the rounding that a rate of zero accumulates over the whole duration.
pub const MIN_APPROACH_PER_ROUNDING: f64 = 4.0;

/// The height along a direction up to which the corners around a point count as level with the point, in units of the
/// distance's rounding. One unit is for the point, and one for the corners.
pub(crate) const LEVEL_HEIGHT_PER_ROUNDING: f64 = 2.0;

/// The distance up to which a face counts as adjacent to a point, in units of the distance's rounding. Such faces are
/// those across an edge that contains the point, and faces that bridge cracks.
pub(crate) const ADJACENCY_DISTANCE_PER_ROUNDING: f64 = 256.0;

/// Returns whether rounding may turn the direction between two points by more than a millionth of a radian. Such a
/// direction is not used as a normal. More exact directions are kept to the bit.
pub(crate) fn is_direction_uncertain(distance: f64, rounding: f64) -> bool {
    // Written so that NaN is blurred.
    !(1e-6 * distance > rounding)
}

/// The least length of a unit vector's component perpendicular to other vectors, for the direction of the component to
/// be used. Rounding turns the component by the inverse of the length, in units of [`UNIT_ROUNDOFF_F64`].
pub(crate) const LEAST_PERPENDICULAR_LENGTH: f64 = 1e-6;

/// The error of the determinant of three vectors, relative to the product of their 1-norms, if at least two of the
/// vectors are differences of points. It also bounds the error of a scalar product of two vectors, relative to the
/// product of their 1-norms.
///
/// Each difference is rounded (1u), the products of three components take 2 more, the six of them are
/// summed in 3: at most 8u; 16u are taken.
pub(crate) const DETERMINANT_ERROR_F64: f64 = 16.0 * UNIT_ROUNDOFF_F64;

/// The deviation of an orthonormal frame computed in f64 from unit lengths and right angles. Twelve rotations of
/// [`UNIT_ROUNDOFF_F64`] each come to less, and f32, to which a box's axes are rounded, is far above.
pub(crate) const FRAME_ERROR_F64: f64 = 1e-13;

/// The amount by which a node's box is widened for tests against rays, relative to its radius. The box's axes are
/// rounded to f32, and the test itself is not exact.
pub(crate) const RAY_BOX_WIDENING_F64: f64 = 1e-5;

/// The gap beyond the margin at which the clock of a pair of nodes stops, in units of the tolerance. It takes up the
/// rounding of nodes that are not too large, so that all of them stop at the same gap. With a slack that grows with the
/// size of the nodes instead, two flat faces that meet would have all of their larger nodes split before a pair of
/// pieces is seen.
pub(crate) const NODE_GAP_TOLERANCE_SHARE: f64 = 7.0 / 8.0;

/// The accepted range of weights of a convex combination before they are divided by their sum. No product of a weight
/// with a coordinate, and no sum of four weights, overflows or underflows.
pub(crate) const WEIGHT_RANGE: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// The least distance from a surface at which a point is certainly inside or outside, in units of the rounding of
/// distances. The positions of both are rounded.
pub(crate) const CERTAIN_SIDE_DISTANCE_PER_ROUNDING: f64 = 4.0;

/// The distance of test points on a flat piece from an edge of another piece, as a fraction of the length of edge that
/// lies on the flat piece. It is far above rounding, and below the distance to other features.
pub(crate) const EDGE_PROBE_DISTANCE_SHARE: f64 = 1e-3;

/// The error of a height `n·x` computed in f64, relative to the product of `|n|₁` and the largest coordinate of `x`.
/// Three products and two sums take at most 3u; 4u are taken.
pub(crate) const HEIGHT_ERROR_F64: f64 = 4.0 * UNIT_ROUNDOFF_F64;

/// The error of the height of a disc that encloses the points of a piece, computed in f32 and in units of the piece's
/// size. The height is along a direction whose largest component is 1.
///
/// In units of `u = 2⁻²⁴`, with lengths of points and of the direction at most √3: the direction is
/// rounded (3u); the center is projected by five operations (12u); radius and thickness are
/// multiplied by lengths of at most √3 (6u and 12u); the normal is not exactly perpendicular to the
/// part across it (12u); the sums add 14u. That is 59u; 96u are taken.
pub(crate) const DISC_HEIGHT_ERROR_F32: f32 = 96.0 * UNIT_ROUNDOFF_F32;

/// The error of the squared component of a direction perpendicular to a disc's normal, relative to the squared length
/// of the direction. The squared length (9u), that of the component along the normal (27u), the normal's length (6u),
/// and the difference (3u) add up to 45u; 64u are taken.
pub(crate) const DISC_TILT_ERROR_F32: f32 = 64.0 * UNIT_ROUNDOFF_F32;

/// The relative error of the least height of a body's points along an axis while the body turns. It is relative to the
/// sum of the points' farthest distances from the center of rotation and from the body's origin.
///
/// The axis in the body's frame is off by the direction of the angular velocity (2u), two products with it
/// (6u), sine and cosine (4u), their products and sums (4u), and the rotation into that frame (7u):
/// 23u. Two points see it with opposite signs: 46u. The search itself adds the rounding of two
/// heights, at most 14u ([`HEIGHT_ERROR_F64`]): 60u; 64u are taken.
pub(crate) const TURNED_SUPPORT_ERROR: f64 = 64.0 * UNIT_ROUNDOFF_F64;

/// Returns a bound of the error of the height `n·x − n·a` of a point above a plane, with `n = u × v`. All three vectors
/// are rounded differences of points, and no coordinate of `x` or `a` exceeds `reach`.
///
/// With `u` half a unit in the last place and `m` the product of the largest coordinates of `u` and
/// `v`: a component of `n` is at most `2m` and off by `8u m`, which a height of two terms of three
/// products multiplies to `2 · 3 · 8u m reach`; coordinates are off by `u reach` (`2 · 3 · 2u m
/// reach`); two dot products and their difference round by `4u` of `2 · 3 · 2m reach`. That is
/// 108u; 128u are taken, plus an allowance for underflow.
pub fn height_rounding(sides: [DVec3; 2], reach: f64) -> f64 {
    let [u, v] = sides.map(|side| side.abs().max_element());
    128.0 * UNIT_ROUNDOFF_F64 * u * v * reach + f64::MIN_POSITIVE
}

/// The error of the extent of a box along an axis, relative to the box's radius. The extent is computed in f64, but the
/// box's axes are orthonormal to f32 only.
///
/// Half sizes are measured along the rounded axes. With `U` the matrix of these, `UᵀU` differs from
/// 1 by at most `2√3 u`, as each axis is off by `u` in length: 3.5u; 4u are taken.
pub(crate) const BOX_EXTENT_ERROR_F32: f64 = 4.0 * UNIT_ROUNDOFF_F32 as f64;

/// The thickness of a node's box up to which the node counts as flat, relative to the box's radius. The box's axis is
/// rounded to f32 ([`BOX_EXTENT_ERROR_F32`]), its size outward.
pub(crate) const MAX_FLAT_NODE_THICKNESS_F32: f32 = 16.0 * UNIT_ROUNDOFF_F32;

/// The error of the velocity along a screw axis, relative to the whole velocity. The axis is off by 4.5u, twice, and
/// products, sums and differences by 9u; 32u are taken.
pub(crate) const SCREW_VELOCITY_ERROR_F64: f64 = 32.0 * UNIT_ROUNDOFF_F64;

/// The amount by which an interval of numbers of turns is widened before the whole numbers in it are taken, both in
/// turns and relative to the numbers. It is far above the rounding of a quotient, a few units in the last place.
pub(crate) const TURN_COUNT_WIDENING: f64 = 1e-9;

/// Returns a bound of the rounding of the values of `f = a r + b ζ` over a node, computed in f64.
/// `engine/shortcuts/screw/profile.rs` explains `f`. The values `n` are `|a|` and `|b|`; `arm` is the distance of the node's
/// center from the rotation's center, and `radius` that of its points from it; `tilt` is the advance per radian,
/// divided by the distance from the axis.
///
/// In units of `u`: a center's offset is rounded (1), its height taken (4) and taken off (2), and the
/// rest measured (4), which is 11 of an arm in `z` and in `r`. The azimuth is off by that in units
/// of the distance from the axis, and by 8 of a half turn: 37 of an arm times the tilt. Products and
/// sums add 4 of each. Gradients are off by 12 of a radius, in their part along `ζ` times `1 + tilt`.
/// Their part along the axis would be off by the height's rounding if that were not taken off twice.
/// That is below 64 of each.
pub(crate) fn profile_rounding(n: [f64; 2], [arm, radius]: [f64; 2], tilt: f64) -> f64 {
    let [a, b] = n;
    64.0 * UNIT_ROUNDOFF_F64 * ((a + b) + b * tilt.abs()) * (arm + radius)
}

/// The factor that enlarges a polygon around a circle, so that it contains the circle despite the rounding of its
/// corners.
///
/// In units of `u`: a corner's angle is off by 9 (a product with 2π, rounded twice), which brings an edge nearer by
/// 6.4 at most; sine and cosine are off by 2, the product by 1, and the radius of the corners, a quotient by a cosine,
/// by 4. That is 13.4, for which 16 are taken.
pub(crate) const POLYGON_ENLARGEMENT: f64 = 1.0 + 16.0 * UNIT_ROUNDOFF_F64;

/// The least positive f64, which bounds the rounding of a product that underflows.
pub(crate) const LEAST_POSITIVE_F64: f64 = f64::from_bits(1);

#[cfg(test)]
mod tests;
