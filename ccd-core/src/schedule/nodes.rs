//! Pairs of nodes, eight at once, in f32.
//!
//! `expand.rs` splits a node, `bounds.rs` bounds its children against the other node, and the pairs wait
//! together in `siblings.rs`.

mod axis;
mod bounds;
mod clock;
pub(super) mod common;
mod eight_pairs;
pub(super) mod expand;
mod free_times;
mod lanes;
mod shape;
pub(super) mod siblings;
mod sweeping_node;
mod turn;
