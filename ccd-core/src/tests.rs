//! Helpers that unit tests share: exact arithmetic, a slow oracle, random scenes and trajectories.

pub(crate) mod double;
pub(crate) mod far_ends;
pub(crate) mod meshes;
pub(crate) mod nearest;
pub(crate) mod oracle;
pub(crate) mod rational;
pub(crate) mod scene;
mod tiny_components;
pub(crate) mod trajectories;
pub(crate) mod worst;
