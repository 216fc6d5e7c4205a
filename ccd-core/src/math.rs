//! Arithmetic on numbers and vectors: rounding, underflow and exact signs.

#[cfg(feature = "exact")]
pub mod exact;
pub(crate) mod instructions;
pub(crate) mod lanes;
pub mod order;
pub(crate) mod packed;
pub mod point_tree;
pub(crate) mod principal;
pub mod vector;
