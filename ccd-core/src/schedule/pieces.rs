//! Pairs of pieces, one at a time, in f64.
//!
//! `pair.rs` decides about a pair. A `snapshot.rs` of the pair calls the oracle, and computes how long a plane keeps
//! the pieces apart: a fixed plane (`heights.rs`) or one that turns with a body (`sweeping_piece.rs`). `level.rs` has
//! the pieces that come to touch on the ground that the bodies rest on. A `meeting.rs` has the surfaces around the
//! nearest points of the pieces.

mod heights;
mod level;
pub(super) mod meeting;
pub(super) mod pair;
pub(super) mod snapshot;
mod sweeping_piece;
