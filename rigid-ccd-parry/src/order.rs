//! Numbers compared, and vectors measured, as everywhere in the engine.

pub(crate) use ccd_core::order::{greater, lesser};
pub(crate) use ccd_core::vector::length;
