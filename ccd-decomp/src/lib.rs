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

mod auto;
mod body;
mod convex;
mod coplanar;
mod disjoint_sets;
mod error;
mod exact_hull;
mod format;
mod hierarchy;
mod hull;
mod hull_tree;
mod manifold;
mod mesh;
mod nesting;
mod polygons;
mod predicates;
mod repair;
mod report;
mod self_intersection;
mod shells;
mod source;
mod star;
mod store;
mod surface;
mod tally;
#[cfg(test)]
mod test_meshes;
mod tolerance;
mod topology;
mod triangle_boxes;
mod vhacd;
mod work;

pub use body::{Detail, Model, Prepared, body_from_mesh, prepare};
pub use error::{BodyError, DecomposeError, MeshError, MeshFault, SourceError};
pub use format::{Format, write_obj, write_obj_pieces};
pub use hierarchy::build_hierarchy;
pub use hull::HullError;
pub use hull_tree::{BuildError, build_hull_tree};
pub use mesh::TriangleMesh;
pub use repair::Repairs;
pub use report::{PiecesKind, Report, Why};
pub use self_intersection::Crossing;
pub use source::{BodySource, parse_body};
pub use store::{STORED_EXTENSION, StoreError, StoreFault};
pub use surface::{Decomposition, Order, Patch, decompose};
pub use tally::Tally;
pub use topology::{Edge, Orientation, Topology};
pub use vhacd::VhacdError;
