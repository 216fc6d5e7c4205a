//! Voronoi marching for [`ccd_core`]: the distance of convex polytopes from the features that were
//! nearest last `[LINCANNY91, VCLIP98, SWIFT01]`.
//!
//! [`Vmarch`] is a [`DistanceOracle`](ccd_core::DistanceOracle) over pieces whose facets are known.
//! Two features, one of either piece, are the nearest ones if the nearest point of each lies in the
//! Voronoi region of the other: a handful of planes each. Where a plane is violated, the feature
//! behind it is nearer; so it marches from pair to pair. From call to call little moves, the last
//! pair is still nearest or next to it, and a call takes a step or two whatever the pieces' size.
//!
//! Choose it for hulls with facets that are asked about again and again. It gives up, typed, on
//! pieces whose facets are missing or wrong, so that another backend can take over:
//!
//! ```
//! use ccd_core::DistanceOracle;
//! use ccd_distance_vmarch::Vmarch;
//! # struct Gjk;
//! # impl DistanceOracle for Gjk {
//! #     type Cache = ();
//! #     fn separation(&mut self, _: &ccd_core::PiecePair<'_>, _: &mut ())
//! #         -> Result<ccd_core::Claim, ccd_core::GiveUp> { Err(ccd_core::GiveUp::BadFacets) }
//! # }
//! let oracle = Vmarch::default().or_else(Gjk);
//! # assert_eq!(oracle.fallbacks(), 0);
//! ```
//!
//! # Guarantee
//! Of pieces whose size and distance are together s:
//! - Separated pieces: the witnesses' distance is the pieces', and the axis certifies it, to 1e-14 s
//!   either, however near they are: the axis is made of the features that hold the witnesses.
//! - Intersecting pieces: both witnesses name the same point, to 1e-14 s, and exact signs prove that
//!   the pieces, as they are placed, have one in common. Pieces that come within 2e-15 s of each
//!   other may be said to touch instead: at the witnesses they do, to that distance.
//! - What can be shown to be neither is given up, never claimed.
//! - Every input ends after a bounded number of steps, and the same input gives the same bits.
//!
//! The size s is that of the pieces, not of their coordinates: those only bring the rounding they were
//! given with. All that for sizes and distances from 1e-45 to 1e12.
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
//! A V or E that is found below an F is in a local minimum: it goes on to the face it is highest
//! above, or is inside of the other piece.
//!
//! # How the files follow the method
//!
//! | step | file |
//! |---|---|
//! | corners, edges, merged faces and their planes, checked | `polytope/`: `facets.rs`, `merge.rs`, `assemble.rs`, `convex.rs` |
//! | both polytopes in one frame | `place.rs` |
//! | where to begin: the last pair, or a table of directions | `start.rs` |
//! | the loop, and Brent's detection of cycles | `march.rs` |
//! | the five tests | as above; edges cut by planes: `clip.rs` |
//! | out of local minima | `escape.rs` |
//! | common points, by exact signs | `penetration.rs`; of what only touches: `touching.rs` |
//! | the nearest points, clamped into their features | `witness.rs` |
//! | what to do at ties, in cycles, at the cap | `settle.rs`, with `certificate.rs` and `around.rs` |
//! | the backend, its cache and its counters | `oracle.rs` |
//!
//! # What rounding makes of it
//! In exact arithmetic no pair is met twice. In floating point:
//! - Planes are told by the same product of the same numbers from either side, so that two states
//!   never both refuse a point. Only edges against edges differ; there what lies within rounding of a
//!   plane stays, where rounding is measured by what a step along both edges can win.
//! - A stop within rounding of a plane is certified by a support gap before it is believed, with the
//!   best axis that the features around allow. If that fails, all features around are compared by
//!   their distance, which is right to rounding, not by the direction in which it falls, which is not.
//! - A cycle is noticed, its best pair certified likewise, or the march is taken up from elsewhere.

#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "comparisons are written so that NaN takes the way out"
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
mod orientation;
mod penetration;
mod placed;
mod polytope;
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

pub use counters::Counters;
pub use oracle::Vmarch;
pub use start::Cache;
