//! The numeric constants of this crate, each with its unit and its reason.
//!
//! `u` is half a unit in the last place of 1.

use ccd_core::rounding::UNIT_ROUNDOFF_F64;

/// The default contact distance in single precision, in the scene's unit of length.
///
/// parry's own casts stop at this distance, rounded: about ten units of rounding of single precision. A tolerance that is
/// twice as large reports contacts at twice the distance. A tolerance of a thousandth of it takes a few percent longer,
/// but single precision cannot distinguish the results.
#[cfg(feature = "f32")]
pub(crate) const DEFAULT_TOLERANCE_F32: f64 = 1e-6;

/// The default contact distance in double precision, in the scene's unit of length. parry's casts stop at 2e-15, which
/// no proof in double precision can reach.
#[cfg(feature = "f64")]
pub(crate) const DEFAULT_TOLERANCE_F64: f64 = 1e-9;

/// The largest default tolerance, as a fraction of the smaller body's radius, so that tiny bodies are not in contact at a
/// distance of their own size.
pub(crate) const MAX_TOLERANCE_RADIUS_RATIO: f64 = 1.0 / (1 << 20) as f64;

/// A bound on the rounding error of a point to which a pose is applied in f64, relative to the lengths of the point and
/// of the translation.
///
/// In units of `u`: normalising the quaternion has an error of 2 in direction, which rotates by 4, and of 4.5 in length,
/// which scales by up to 9. Products and sums of the rotation add 15, the translation 1. The total is 29; the bound uses
/// 64.
pub(crate) const POSE_ROUNDING: f64 = 64.0 * UNIT_ROUNDOFF_F64;

/// A bound on the rounding error of a voxel's corner, relative to its coordinates. The corner is one rounded product;
/// the sums that bound its error add two more.
pub(crate) const VOXEL_ROUNDING: f64 = 4.0 * UNIT_ROUNDOFF_F64;

/// A bound on the relative rounding error of heights above a half-space's plane. It is relative to the summands of a
/// height, and, for the corners of the half-space's box, to the corners' distances.
///
/// In units of `u`: normalising the normal adds 3. The first axis across the normal adds 6, and 6 for its angle to the
/// normal. The second axis adds 10, products and sums add 8. The total is 33; the bound uses 64.
pub(crate) const PLANE_HEIGHT_ROUNDING: f64 = 64.0 * UNIT_ROUNDOFF_F64;

/// The maximum extent of the box that replaces a half-space, in units of the sum of the body's size and its distance at
/// the start. At this extent the box is accurate to 2e-5 of that sum.
pub(crate) const MAX_HALF_SPACE_BOX_EXTENT: f64 = (1 << 26) as f64;

/// A bound on the error that rounding the relative velocity adds to the bodies' relative displacement, as a fraction of
/// that displacement. The subtraction is one operation; the displacement's own rounding adds as much.
pub(crate) const VELOCITY_DIFFERENCE_ROUNDING: f64 = 2.0 * UNIT_ROUNDOFF_F64;

/// The factor by which lengths and durations are enlarged to cover their rounding errors. The sums and quotients that
/// they come from have an error of less than a thousand `u`. A longer interval costs nothing.
pub(crate) const ROUNDING_ENLARGEMENT: f64 = 1.0 + 1024.0 * UNIT_ROUNDOFF_F64;

/// The fraction of the engine's limits of displacement and rotation that a cast uses; the rest covers rounding.
pub(crate) const USED_SHARE_OF_LIMITS: f64 = 0.999;

/// The longest duration of a cast, for which products of a duration and a speed stay finite.
pub(crate) const LONGEST_DURATION: f64 = 1e250;

/// The work limit of the search for the nearest points of a cast that reached a limit.
pub(crate) const NEAREST_POINTS_BUDGET: u64 = 1 << 16;

/// The largest approach rate of overlapping bodies that counts as sliding, relative to their speed. The direction of
/// least overlap has an error of some thousand `u`.
pub(crate) const MAX_SLIDING_APPROACH_RATIO: f64 = 1.0 / (1u64 << 40) as f64;
