//! Cuts meshes into convex pieces: one hull, patches of the surface, or approximate hulls.

pub(crate) mod convex;
pub(crate) mod patches;
mod polytope;
pub(crate) mod vhacd;
