//! Queries other than the first contact of two motions: any contact, the closest approach, searches in steps, and
//! trajectories.
//!
//! `any.rs` asks whether bodies touch at all, `closest.rs` how close they come; both search as
//! `depth_first.rs` does. `steps.rs` has the search for a first contact that stops at a time and continues later. `along.rs`
//! asks about bodies that move along trajectories.

pub(crate) mod along;
pub(crate) mod any;
pub(crate) mod closest;
pub(crate) mod depth_first;
pub(crate) mod steps;
