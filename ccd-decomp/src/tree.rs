//! Trees over convex pieces.

pub(crate) mod hierarchy;
pub(crate) mod hull_tree;
