//! Whether a mesh bounds a solid, and the surface of one that does.

pub(crate) mod crossings;
pub(crate) mod flats;
pub(crate) mod manifold;
pub(crate) mod nesting;
pub(crate) mod shells;
pub(crate) mod star;
pub(crate) mod topology;
