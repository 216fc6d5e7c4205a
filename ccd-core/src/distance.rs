//! The distance of two pieces: the claim of a backend, and the bounds proven from it.

pub(crate) mod common_normals;
pub(crate) mod oracle;
pub(crate) mod overlap;
pub(crate) mod separation;
