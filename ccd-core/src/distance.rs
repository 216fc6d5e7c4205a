//! The distance of two pieces: claims of backends, and the bounds that are proven from them.

pub(crate) mod common_normals;
pub(crate) mod oracle;
pub(crate) mod overlap;
pub(crate) mod separation;
