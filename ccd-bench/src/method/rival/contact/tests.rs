mod enclosures;
mod meshes;
mod scenes;
