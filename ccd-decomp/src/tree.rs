//! Builds trees over convex pieces: hierarchies of boxes, and hull trees.

pub(crate) mod hierarchy;
pub(crate) mod hull_tree;
mod slot;
