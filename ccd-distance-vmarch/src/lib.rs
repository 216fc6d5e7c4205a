//! Voronoi marching as a distance oracle for [`ccd_core`]. It computes distances of convex polytopes from the features
//! that were nearest last time `[LINCANNY91, VCLIP98, SWIFT01]`.
//!
//! [`Vmarch`] is a [`DistanceOracle`](ccd_core::DistanceOracle) for pieces whose facets are known.
//! Two features, one of either piece, are the nearest ones if the nearest point of each is in the
//! Voronoi region of the other, which a handful of planes bound. If a plane is violated, the
//! feature on its other side is nearer, and the march goes on to that. Pieces move little from call
//! to call: the last pair is still nearest, or next to it, and a call takes a step or two for
//! pieces of any size.
//!
//! Choose it for repeated queries of hulls with facets. Two boxes come nearer, one corner ahead:
//!
//! ```
//! use ccd_core::glam::{DMat3, DQuat, DVec3};
//! use ccd_core::{Body, DistanceOracle, Frame, InputError, PiecePair};
//! use ccd_distance_vmarch::{Cache, Vmarch};
//!
//! let cube = Body::cuboid([1.0; 3])?;
//! let piece = cube.pieces().get(0);
//! let turn = DQuat::from_rotation_arc(DVec3::ONE / 3f64.sqrt(), -DVec3::Z);
//! let (mut oracle, mut cache) = (Vmarch::default(), Cache::default());
//! for height in [5.0, 4.9, 4.8] {
//!     let b_to_a = Frame {
//!         translation: height * DVec3::Z,
//!         rotation: DMat3::from_quat(turn),
//!     };
//!     let pair = PiecePair { a: piece, b: piece, b_to_a };
//!     let claim = oracle.separation(&pair, &mut cache).unwrap();
//!     let [on_a, on_b] = [claim.a, claim.b].map(|point| point.position(piece.points).unwrap());
//!     let distance = on_a.distance(b_to_a.transform_point(on_b));
//!     assert!((distance - (height - 1.0 - 3f64.sqrt())).abs() < 1e-15);
//! }
//! // The later calls found the nearest features where the first one left them.
//! assert!(oracle.counters().steps < 10);
//! # Ok::<(), InputError>(())
//! ```
//!
//! It gives up, with a reason, on pieces whose facets are missing or wrong. Another backend then
//! takes over: `Vmarch::default().or_else(Gjk)`.
//!
//! # Guarantee
//! For pieces whose size and distance are together s:
//! - Separated pieces: the witnesses' distance is accurate, and the axis certifies it, to 1e-14 s
//!   each, at any distance: the axis is computed from the features that contain the witnesses.
//! - Intersecting pieces: both witnesses name the same point, to 1e-14 s. Exact signs prove that
//!   the pieces, as placed, have a common point. Pieces that come within 2e-15 s of each other may
//!   be claimed to touch instead: at the witnesses they do, to that distance.
//! - A pair for which neither can be shown is given up, never claimed.
//! - Every input ends after a bounded number of steps, and the same input gives the same bits.
//!
//! The size s is that of the pieces, not of their coordinates, which only have their input
//! rounding. This holds for sizes and distances from 1e-45 to 1e12.
//!
//! # States and transitions
//! A state is a pair of features, V, E or F; every test is made in A's frame.
//!
//! | state | stays, as nearest, if | goes on to | file |
//! |---|---|---|---|
//! | V-V | each is before the other's vertex-edge planes | the edge V-E behind the most violated one | `vertex_vertex.rs` |
//! | V-E | V is between E's four planes, and E's nearest point before V's | V-V, V-F behind E's plane; E-E behind V's | `vertex_edge.rs` |
//! | E-E | the nearest points are within both, each between the other's face-edge planes | V-V, V-E at an end; E-F behind a plane | `edge_edge.rs` |
//! | V-F | V is above F, within its prism, and no edge of V falls towards F | V-E behind the most violated plane; E-F along the steepest edge | `vertex_face.rs` |
//! | E-F | never | V-F, E-E where E is lowest; E-E at the nearest side | `edge_face.rs` |
//! | F-F | never met | | |
//!
//! A V or E that is found below an F is in a local minimum. It goes on to the face with the largest
//! height, or is inside the other piece.
//!
//! # How the files follow the method
//!
//! | step | file |
//! |---|---|
//! | the backend; its counters | `oracle.rs`; `counters.rs` |
//! | corners, edges, merged faces and their planes, checked | `polytope.rs`; `polytope/`: `build.rs`, `facets.rs`, `merge.rs`, `assemble.rs`, `convex.rs` |
//! | normals of slivers | `double_double.rs` |
//! | extremal corners: a table of directions, hill climbing | `polytope/support.rs` |
//! | both polytopes in one frame | `placed.rs` |
//! | features, pairs of them, and what a test of a pair says | `feature.rs` |
//! | where a march begins, and what the next call starts from | `start.rs` |
//! | the march | `march.rs` |
//! | how it ends, and Brent's detection of cycles | `termination.rs` |
//! | the five tests | as above; edges cut by planes: `clip.rs` |
//! | out of local minima | `escape.rs` |
//! | common points, by exact signs; the axis of pieces that only touch | `penetration.rs`; `touching.rs` |
//! | the nearest points, clamped into their features | `witness.rs` |
//! | ties, cycles, the cap of steps | `certify.rs`, with `certificate.rs` and `neighbourhood.rs` |
//! | every tolerance | `tolerance.rs` |
//!
//! # The effect of rounding
//! In exact arithmetic no pair occurs twice. In floating point:
//! - A plane's side is the same product of the same numbers from either feature, so that two states never both refuse a
//!   point. Only edges against edges differ. There a point within rounding of a plane stays; rounding is measured by
//!   the possible gain of a step along both edges.
//! - A stop within rounding of a plane is certified by a support gap, with the best axis of the
//!   features around. If that fails, all features around are compared by their distance. It is
//!   accurate up to rounding; the direction in which it decreases is not.
//! - A cycle is noticed, and its nearest pair is certified likewise. If that fails, the march restarts
//!   at the corners that are extremal along the best axis.

#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "comparisons are written so that NaN takes the offset out"
)]

mod certificate;
mod certify;
mod clip;
mod counters;
mod double_double;
mod edge_edge;
mod edge_face;
mod escape;
mod feature;
mod march;
mod neighbourhood;
mod oracle;
mod penetration;
mod placed;
mod polytope;
#[cfg(test)]
#[allow(dead_code)]
#[path = "../../ccd-core/src/tests/rational.rs"]
mod rational;
mod start;
mod termination;
#[cfg(test)]
mod tests;
mod tolerance;
mod touching;
mod vertex_edge;
mod vertex_face;
mod vertex_vertex;
mod witness;
#[cfg(test)]
#[allow(dead_code)]
#[path = "../../ccd-core/src/tests/worst.rs"]
mod worst;

pub use counters::Counters;
pub use oracle::Vmarch;
pub use start::Cache;

/// Compiles the code in the README as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;
