//! The distance between two pieces: the interface of the oracles, and the bounds that are proven from their claims.

pub(crate) mod common_normals;
pub(crate) mod containment;
pub(crate) mod oracle;
pub(crate) mod overlap;
pub(crate) mod separation;
