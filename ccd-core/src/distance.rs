//! The distance between two pieces: the interface of the backends that measure it, and the bounds that are proven from
//! what they claim.

pub(crate) mod common_normals;
pub(crate) mod containment;
pub(crate) mod oracle;
pub(crate) mod overlap;
pub(crate) mod separation;
