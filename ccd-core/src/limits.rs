//! Default settings of a query, and the ranges of accepted numbers.

/// The default tolerance of a query, in the scene's unit of length `[FAST06 §6.2]`.
pub const DEFAULT_TOLERANCE: f64 = 1e-3;

/// The default limit of a query's [work](crate::Stats::budgeted_work). It allows a few seconds, and less than a gigabyte of
/// waiting pairs (at most 0.6 in measurements, with the schedule `Fast`).
pub const DEFAULT_BUDGET: u64 = 1 << 22;

/// The least accepted tolerance, in the scene's unit of length. Squares of relevant distances stay above the
/// underflow of f64 (2.2e-308).
pub const LEAST_TOLERANCE: f64 = 1e-100;

/// The largest coordinate of points, positions and centers, and the largest travel, margin and tolerance, in the
/// scene's unit of length. Squares of distances, and of speeds at the [largest turn](MAX_ROTATION_ANGLE), stay below
/// the overflow of f32 (3.4e38).
pub const MAX_COORDINATE: f64 = 1e12;

/// The least nonzero magnitude of a coordinate for which exact predicates are exact.
///
/// The last bit of a coordinate c is at least 2⁻⁵³ |c|. The error terms of a determinant are
/// multiples of the product of three such bits, which must not underflow: (2⁻⁵³ · 1e-90)³ > 2⁻¹⁰⁷⁴.
pub const LEAST_NONZERO_COORDINATE: f64 = 1e-90;

/// The longest duration of a query about trajectories, in the scene's unit of time.
///
/// Derivatives of the fourth order are bounded. The part that underflows, 5e-324, moves a point by less than the
/// [least tolerance](LEAST_TOLERANCE) in that time: `5e-324 · (1e50)⁴ < 1e-100`.
pub const MAX_DURATION: f64 = 1e50;

/// The largest rotation of one motion, in radians. Beyond it the rounding of the angle alone moves a point by 1e-10 of
/// its arm.
pub const MAX_ROTATION_ANGLE: f64 = 1e6;

/// The default excess of polytopes around cylinders and cones, as a share of the radius. It takes 144 corners around
/// the circle, and makes contacts early by at most a quarter of a thousandth of the radius.
pub const DEFAULT_RADIUS_EXCESS_SHARE: f64 = 1.0 / 4096.0;

/// The largest number of corners of a polygon around a circle. Such a polygon exceeds the circle by 1.84e-8 of its
/// radius.
pub const MAX_CIRCLE_CORNERS: f64 = 16384.0;
