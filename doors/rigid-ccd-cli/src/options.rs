//! Values that options take.

pub(crate) mod named;
pub(crate) mod numbers;
pub(crate) mod solver_kind;
