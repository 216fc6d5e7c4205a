//! Distances of two convex pieces for [`ccd_core`]: closed forms for up to three points, GJK for all others.
//!
//! Each backend is a [`DistanceOracle`](ccd_core::DistanceOracle). It names a pair of nearest points, and
//! an axis that proves how far apart the pieces are. The engine checks both.
//!
//! | backend | pieces | method | choose it |
//! |---|---|---|---|
//! | [`Direct`] | any | [`ClosedForm`], and [`Gjk`] where that gives up | when in doubt |
//! | [`ClosedForm`] | 1 to 3 points | all pairs of features at once, in closed form | for triangle meshes; balls and capsules too |
//! | [`Gjk`] | any | GJK with a warm start | for hulls and patches |
//!
//! Two units above the middle of a square:
//!
//! ```
//! use ccd_core::{DistanceOracle, Frame, Piece, PiecePair, glam::DVec3};
//! use ccd_distance_gjk::Direct;
//! let square = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y];
//! let point = [DVec3::new(0.5, 0.5, 2.0)];
//! let pair = PiecePair {
//!     a: Piece::from_points(&square),
//!     b: Piece::from_points(&point),
//!     b_to_a: Frame::IDENTITY,
//! };
//! let mut oracle = Direct::default();
//! let claim = oracle.separation(&pair, &mut Default::default()).unwrap();
//! assert_eq!(claim.a.position(&square), Some(DVec3::new(0.5, 0.5, 0.0)));
//! assert_eq!(claim.axis.normalize(), DVec3::Z);
//! // A square has four points: GJK has answered.
//! assert_eq!(oracle.fallbacks(), 1);
//! ```
//!
//! # Guarantee
//! All backends promise, for pieces whose size and distance are together s:
//! - Separated pieces: the error of the witnesses' distance is at most 1e-13 s. Next to needles
//!   thinner than 1e-7 s, and nearer than that, it is at most their width. The axis certifies that
//!   distance to 1e-12 s if it exceeds 1e-3 s, and at least half of it down to 1e-11 s. If the
//!   witnesses' difference is mostly rounding, the axis is computed from the features that contain
//!   them.
//! - Intersecting pieces: both witnesses are the same point, to 1e-12 s. For pieces flattened down
//!   to 1e-12 of their size, they are the same to 1e-6 s.
//! - Touching pieces: their insides are apart along the axis, to 1e-14 s.
//! - The size s is that of the pieces, not of their coordinates, which only have their input
//!   rounding.
//! - Every input ends after a bounded number of steps, and the same input gives the same bits.
//!
//! This holds for sizes and distances from 1e-45 to 1e15; smaller ones underflow.
//!
//! # How the files follow the method
//!
//! | step | file |
//! |---|---|
//! | the closed forms as a backend | `closed_form.rs` |
//! | edges against edges, corners against faces | `closed_form/nearest.rs` |
//! | axes of features, for small distances | `closed_form/axis.rs` |
//! | a common point of intersecting triangles | `closed_form/pierce.rs` |
//! | four vectors at once | `lanes.rs` |
//! | GJK as a backend | `gjk/oracle.rs` |
//! | the first simplex, and what the next call starts from | `gjk/start.rs` |
//! | the GJK search, and when it stops | `gjk/search.rs`, `gjk/termination.rs` |
//! | the Minkowski difference and its support | `gjk/minkowski.rs` |
//! | the point of a simplex nearest to the origin | `gjk/simplex.rs`, `gjk/foot.rs`; `gjk/segment.rs`, `gjk/triangle.rs`, `gjk/tetrahedron.rs` |
//! | better axes where rounding stalls the search | `gjk/sharpen.rs`, `gjk/fan.rs` |
//! | nearer witnesses there | `gjk/refine.rs` |
//! | bounds only as tight as they are needed | `gjk/bounds.rs` |
//! | every tolerance | `tolerance.rs` |

#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "comparisons are written so that NaN takes the way out"
)]

mod closed_form;
mod gjk;
mod lanes;
#[cfg(test)]
#[path = "../../ccd-core/src/tests/rational.rs"]
mod rational;
#[cfg(test)]
mod tests;
mod tolerance;
#[cfg(test)]
#[allow(dead_code)]
#[path = "../../ccd-core/src/tests/worst.rs"]
mod worst;

pub use closed_form::ClosedForm;
pub use gjk::{Cache, DistanceBounds, Gjk, TerminationBounds, Vertex, bound_distance};

/// The recommended oracle: the closed form for up to three points, GJK otherwise.
pub type Direct = ccd_core::OrElse<ClosedForm, Gjk>;

/// Compiles the code in the README as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;
