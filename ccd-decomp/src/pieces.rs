//! Meshes cut into convex pieces.

pub(crate) mod convex;
pub(crate) mod patches;
pub(crate) mod vhacd;
