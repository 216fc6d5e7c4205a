//! The defaults of a query, and the numbers that are accepted.

/// The tolerance of a query that names none, in the scene's unit of length `[FAST06 §6.2]`.
pub const DEFAULT_TOLERANCE: f64 = 1e-3;

/// The [work](crate::Stats::work) that a query may take that names no budget: a few seconds, and less
/// than a gigabyte of pairs that wait (0.6 at worst, seen with the schedule `Fast`).
pub const DEFAULT_BUDGET: u64 = 1 << 22;

/// The least tolerance that can be asked for, in the scene's unit of length: squares of distances
/// that matter stay above the underflow of f64 (2.2e-308).
pub const LEAST_TOLERANCE: f64 = 1e-100;

/// The largest coordinate of points, positions and centres, and the longest travel, margin and tolerance,
/// in the scene's unit of length: squares of distances, and of speeds after the [largest turn](MAX_TURN),
/// stay below the overflow of f32 (3.4e38).
pub const MAX_COORDINATE: f64 = 1e12;

/// Coordinates nearer to 0 than this, 0 itself excepted, are too fine for exact predicates.
///
/// The last bit of a coordinate c is at least 2⁻⁵³ |c|, the error terms of a determinant are multiples
/// of the product of three such bits, and that has to be a number: (2⁻⁵³ · 1e-90)³ > 2⁻¹⁰⁷⁴.
pub const LEAST_COORDINATE: f64 = 1e-90;

/// The largest turn of one motion, in radians. Beyond it the rounding of the angle alone moves a
/// point by 1e-10 of its arm.
pub const MAX_TURN: f64 = 1e6;
