//! Makes convex pieces of meshes: the solid itself, patches of the surface, or a hull that encloses the mesh.

pub(crate) mod convex;
pub(crate) mod outer_hull;
pub(crate) mod patches;
mod polytope;
