//! Meshes in, bodies out: readers, checks, repairs and hierarchies for `ccd-core`.
//!
//! ```text
//! file ─ format ─► TriangleMesh ─┬─ topology ───────────────────► solid or surface ─┐
//!                                ├─ (triangles) ───┐                                │
//!                                ├─ manifold ─┬─ convex ────┐                       │
//!                                │            └─ coplanar ─ surface ─┤              │
//!                                └─ vhacd ─────────┴─► pieces ─ hierarchy ──────────┴─► Model ─► Body
//! ```
//!
//! | to … | see |
//! |---|---|
//! | read OBJ, STL, PLY or OFF | [`TriangleMesh::read`], [`Format`] |
//! | know what was wrong with a mesh | [`Repairs`], [`Topology`], [`MeshFault`] |
//! | make a body of it | [`body_from_mesh`], [`Detail`], [`Report`] |
//! | decompose its surface exactly | [`decompose`], [`Decomposition`] |
//! | store what was prepared, and load it | [`prepare`], [`Model::save`], [`Model::load`] |
//! | take a body from a command line | [`parse_body`], [`BodySource`] |
//! | build a hierarchy, or a tree of hulls, over pieces of any kind | [`build_hierarchy`], [`build_hull_tree`] |
//!
//! # Guarantee
//! No repair removes a point of the surface: what is dropped lies on a face that is kept, so that a
//! query on the body cannot miss a contact that the file's own faces would have. Faces and vertices
//! keep the numbers they have in the file, from 0.
//!
//! ```
//! use ccd_decomp::{body_from_mesh, Detail, Format, TriangleMesh};
//! let file = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
//! let mesh = TriangleMesh::from_reader(Format::Obj, file.as_bytes()).unwrap();
//! let prepared = body_from_mesh(&mesh, Detail::Auto).unwrap();
//! assert_eq!(prepared.report.to_string(), "1 convex hull, solid");
//! ```

mod bounds;
mod disjoint_sets;
mod exact;
mod file;
mod hull;
mod mesh;
mod messages;
mod pieces;
mod prepare;
mod search;
mod solid;
mod source;
mod tally;
#[cfg(test)]
mod test_meshes;
mod tolerance;
mod tree;
mod work;

pub use file::STORED_EXTENSION;
pub use file::error::{StoreError, StoreFault};
pub use file::obj::{write_obj, write_obj_pieces};
pub use hull::HullError;
pub use mesh::TriangleMesh;
pub use mesh::error::{MeshError, MeshFault};
pub use mesh::format::Format;
pub use mesh::repair::Repairs;
pub use pieces::patches::{Decomposition, Order, Patch, decompose};
pub use pieces::vhacd::VhacdError;
pub use prepare::error::PrepareError;
pub use prepare::model::{Model, Prepared};
pub use prepare::report::{PiecesKind, Report, Why};
pub use prepare::{Detail, body_from_mesh, prepare};
pub use solid::error::{Crossing, DecomposeError};
pub use solid::topology::{Edge, Orientation, Topology};
pub use source::error::{BodyError, SourceError};
pub use source::{BodySource, parse_body};
pub use tally::Tally;
pub use tree::hierarchy::build_hierarchy;
pub use tree::hull_tree::{BuildError, build_hull_tree};
