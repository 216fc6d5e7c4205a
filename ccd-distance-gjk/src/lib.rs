//! Distance backends for [`ccd_core`]: closed forms for the smallest pieces, GJK for all others.
//!
//! Each is a [`DistanceOracle`](ccd_core::DistanceOracle): for two convex pieces it names a pair of
//! nearest points, and an axis that proves how far apart they are. The engine checks both.
//!
//! | backend | pieces | how | choose it |
//! |---|---|---|---|
//! | [`ClosedForm`] | 1 to 3 points | all pairs of features at once, in closed form | for triangle meshes; balls and capsules too |
//! | [`Gjk`] | any | GJK in f64, warm start | for hulls and patches |
//! | [`Direct`] | any | [`ClosedForm`], or [`Gjk`] where that gives up | when in doubt |
//!
//! # Guarantee
//! What all of them promise, of pieces whose size and distance are together s:
//! - Separated pieces: the witnesses' distance is the pieces' to 1e-13 s; beside needles thinner than
//!   1e-7 s, and nearer than that, to their width. The axis certifies that
//!   distance to 1e-12 s where it exceeds 1e-3 s, and at least half of it down to 1e-11 s: where the
//!   witnesses' difference is mostly rounding, the axis is made of the features that hold them.
//! - Intersecting pieces: both witnesses are the same point, to 1e-12 s; of pieces pressed flat, down to
//!   1e-12 of their size, to 1e-6 s.
//! - Touching pieces: an axis along which their insides are apart, to 1e-14 s.
//! - The size s is that of the pieces, not of their coordinates: those only bring the rounding they
//!   were given with.
//! - Every input ends after a bounded number of steps, and the same input gives the same bits.
//!
//! All that for sizes and distances from 1e-45 to 1e15; smaller ones run into underflow.
//!
//! # How the files follow the method
//!
//! | step | file |
//! |---|---|
//! | edges against edges, corners against faces | `closed_form/nearest.rs` |
//! | axes of features, for small distances | `closed_form/axis.rs` |
//! | a common point of what intersects | `closed_form/pierce.rs` |
//! | the GJK search | `gjk/search.rs`, stopped by `gjk/termination.rs` |
//! | its support | `gjk/minkowski.rs` |
//! | the nearest point of a simplex | `gjk/segment.rs`, `gjk/triangle.rs`, `gjk/tetrahedron.rs` |
//! | where rounding stalls it: axes, witnesses | `gjk/sharpen.rs` and `gjk/fan.rs`, `gjk/refine.rs` |

#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "comparisons are written so that NaN takes the way out"
)]

mod closed_form;
mod gjk;
mod lanes;
#[cfg(test)]
mod tests;
mod tolerance;

pub use closed_form::ClosedForm;
pub use gjk::{Cache, Gjk};

/// The closed form where there is one, GJK elsewhere.
///
/// ```
/// use ccd_core::{DistanceOracle, Frame, Piece, PiecePair, glam::DVec3};
/// use ccd_distance_gjk::Direct;
/// let square = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y];
/// let point = [DVec3::new(0.5, 0.5, 2.0)];
/// let pair = PiecePair {
///     a: Piece::from_points(&square),
///     b: Piece::from_points(&point),
///     b_to_a: Frame::IDENTITY,
/// };
/// let mut oracle = Direct::default();
/// let claim = oracle.separation(&pair, &mut Default::default()).unwrap();
/// assert_eq!(claim.a.of(&square), Some(DVec3::new(0.5, 0.5, 0.0)));
/// assert_eq!(oracle.fallbacks(), 1);
/// ```
pub type Direct = ccd_core::OrElse<ClosedForm, Gjk>;
