//! Pairs of pieces, one at a time, in f64.
//!
//! `pair.rs` decides; a `snapshot.rs` of the pair asks the oracle and finds for how long a plane keeps the
//! pieces apart: one that stands still (`heights.rs`) or one that turns with a body
//! (`sweeping_piece.rs`).

mod heights;
pub(super) mod pair;
pub(super) mod snapshot;
mod sweeping_piece;
