//! Bounds of the times for which pairs of pieces stay apart, one pair at a time in f64.
//!
//! `pair.rs` decides about a pair. A `snapshot.rs` of the pair calls the oracle, and computes how long a plane keeps
//! the pieces apart: by the rates of their points at present (`present_rate.rs`), or by their `heights.rs` over time.
//! `level.rs` has the pieces that come to touch on the ground that the bodies rest on.

pub(crate) mod heights;
mod level;
pub(crate) mod pair;
mod present_rate;
pub(crate) mod snapshot;
