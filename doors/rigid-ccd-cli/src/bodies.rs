//! Bodies and scenes, as options and tables describe them.

pub(crate) mod meshes;
pub(crate) mod pair;
pub(crate) mod scene_table;
mod size;
