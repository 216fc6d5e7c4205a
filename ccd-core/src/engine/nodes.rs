//! Bounds of the distances of pairs of tree nodes, and of the times for which they stay apart, eight pairs at once in
//! f32.
//!
//! `expand.rs` splits a node, `bounds.rs` bounds its children against the other node, and the pairs wait together in
//! `siblings.rs`.

pub(crate) mod axis;
mod bounds;
pub(crate) mod clock;
pub(crate) mod common;
pub(crate) mod eight_pairs;
pub(crate) mod expand;
pub(crate) mod free_times;
pub(crate) mod shape;
pub(crate) mod siblings;
pub(crate) mod split;
