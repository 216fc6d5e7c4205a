//! Arithmetic on numbers and vectors: rounding, underflow and exact signs.

pub(crate) mod componentwise;
pub mod double_double;
#[cfg(feature = "exact")]
pub mod exact;
pub mod order;
pub mod point_tree;
pub(crate) mod principal;
pub mod simd;
pub mod vector;
