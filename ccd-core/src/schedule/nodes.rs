//! Pairs of nodes, eight at once, in f32.
//!
//! `expand.rs` splits a node, `bounds.rs` bounds its children against the other node, and the pairs wait together in
//! `siblings.rs`. If f32 or fixed planes prove little, `closer_look.rs` computes tighter bounds in f64.

mod approach;
mod axis;
mod bounds;
mod clock;
pub(super) mod closer_look;
pub(super) mod common;
mod eight_pairs;
pub(super) mod expand;
mod flat_pair;
mod free_times;
mod lanes;
mod outline;
mod placed;
mod profile;
pub(super) mod roots;
pub(super) mod screw;
mod shape;
pub(super) mod siblings;
mod sweeping_node;
mod turn;
