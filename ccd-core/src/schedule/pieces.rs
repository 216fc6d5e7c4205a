//! Pairs of pieces, one at a time, in f64.

mod heights;
pub(super) mod pair;
pub(super) mod snapshot;
mod sweeping_piece;
