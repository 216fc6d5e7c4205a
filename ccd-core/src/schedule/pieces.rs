//! Pairs of pieces, one at a time, in f64.
//!
//! `pair.rs` decides. A `snapshot.rs` of the pair asks the oracle and finds how long a plane keeps
//! the pieces apart: a fixed plane (`heights.rs`) or one that turns with a body
//! (`sweeping_piece.rs`). Pieces that come to touch on the ground that the bodies rest on are `level.rs`.
//! A `meeting.rs` knows the surfaces around their nearest points.

mod heights;
mod level;
pub(super) mod meeting;
pub(super) mod pair;
pub(super) mod snapshot;
mod sweeping_piece;
