//! Numbers and vectors: what rounds, what underflows, and what is exact.

#[cfg(feature = "exact")]
pub mod exact;
pub mod order;
pub mod point_tree;
pub(crate) mod principal;
pub mod vector;
