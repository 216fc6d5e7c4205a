//! Meshes cut into convex pieces: one hull, patches of the surface, or approximate hulls.

pub(crate) mod convex;
pub(crate) mod patches;
pub(crate) mod vhacd;
