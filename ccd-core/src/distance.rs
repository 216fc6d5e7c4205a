//! The distance of two pieces: what a backend claims, and what is proven of it.

pub(crate) mod oracle;
pub(crate) mod overlap;
pub(crate) mod separation;
