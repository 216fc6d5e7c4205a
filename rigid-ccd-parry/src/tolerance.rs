//! Every number of this crate that is not exact: its unit, and the reason for its value.
//!
//! `u` is half a unit in the last place of 1.

use ccd_core::rounding::U64;

/// The default distance at which single precision is in contact, in the scene's unit of length.
///
/// It is what parry's own casts stop at, ten units of rounding of single precision, rounded down. Twice as much
/// reports twice as early; a thousandth of it takes a few percent longer, for contacts that single precision can
/// not tell apart.
#[cfg(feature = "f32")]
pub(crate) const CONTACT_F32: f64 = 1e-6;

/// The default distance at which double precision is in contact, in the scene's unit of length. parry's casts stop
/// at 2e-15, which no proof in double precision can reach.
#[cfg(feature = "f64")]
pub(crate) const CONTACT_F64: f64 = 1e-9;

/// The default tolerance is at most this part of the smaller body's radius: bodies of a micrometre, in metres, are
/// not in contact at their own size.
pub(crate) const SHARE_OF_SIZE: f64 = 1.0 / (1 << 20) as f64;

/// Bounds how far a point is from its place after a pose is applied in f64, relative to the lengths of the point and
/// of the translation.
///
/// In units of `u`: the given quaternion is normalised with an error of 2 in direction, which turns by 4, and of 4.5
/// in length, which scales by up to 9; products and sums of the rotation add 15, the translation 1. That is 29; 64
/// are taken.
pub(crate) const PLACED: f64 = 64.0 * U64;

/// Bounds how far a corner of a voxel is from its place, relative to its coordinates: one product, and two of it in
/// sums that bound it.
pub(crate) const GRID: f64 = 4.0 * U64;

/// Bounds how far corners of a box that stands in for a half-space are from its plane, relative to their distances, and
/// the rounding of heights, relative to what they are sums of.
///
/// In units of `u`: a normal made a unit is off by 3, an axis across it by 6 and not at a right angle by 6, the other one
/// by 10; products and sums add 8. That is 33; 64 are taken.
pub(crate) const FACE: f64 = 64.0 * U64;

/// How far a body is followed along a half-space, in units of its size and of its distance from where the other one is
/// at the start: at that width the box that stands in for the plane is known to 2e-5 of the size.
pub(crate) const FARTHEST_ALONG: f64 = (1 << 26) as f64;

/// Bounds how far bodies are off for the rounding of the difference of their velocities, relative to the way that they
/// move past each other: one operation, and as much for the way.
pub(crate) const RELATIVE: f64 = 2.0 * U64;

/// The factor on lengths and times that end an interval, which makes up for their rounding: the sums and quotients
/// that they come from have an error of less than a thousand `u`. A longer interval costs nothing.
pub(crate) const BEYOND: f64 = 1.0 + 1024.0 * U64;

/// The part of the engine's limits of travel and turn that is used, which leaves room for their rounding.
pub(crate) const USED: f64 = 0.999;

/// The longest duration that is asked for: products with it stay finite.
pub(crate) const LONGEST: f64 = 1e250;

/// The most work to find the nearest points of a cast that reached a limit.
pub(crate) const LOOK: u64 = 1 << 16;

/// The part of their speed at which overlapping bodies may approach and still count as sliding along each other: the
/// direction in which they overlap least is known to some thousand `u`.
pub(crate) const ALONG: f64 = 1.0 / (1u64 << 40) as f64;
