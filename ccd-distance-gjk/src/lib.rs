//! WIP
mod direct;
mod gjk;
mod lanes;
#[cfg(test)]
mod tests;
mod tolerance;

pub use direct::Direct;
pub use gjk::{Cache, Gjk, GjkF32};

/// WIP
pub type Auto = ccd_core::OrElse<Direct, Gjk>;
