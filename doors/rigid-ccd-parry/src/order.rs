//! Comparisons of numbers and lengths of vectors, the same as in the engine.

pub(crate) use ccd_core::order::{greater, lesser};
pub(crate) use ccd_core::vector::length;
