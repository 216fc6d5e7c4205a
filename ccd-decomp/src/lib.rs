//! Meshes in, bodies out: readers, checks, repairs and hierarchies for `ccd-core`.
//!
//! ```text
//! file ─ format ─► TriangleMesh ─ topology ─► solid or surface ─┐
//!                       │                                       ├─► Prepared { body, report }
//!                       └─ pieces ─ hierarchy ──────────────────┘
//! ```
//!
//! | to … | see |
//! |---|---|
//! | read OBJ, STL, PLY or OFF | [`TriangleMesh::read`], [`Format`] |
//! | know what was wrong with a mesh | [`Repairs`], [`Topology`], [`MeshFault`] |
//! | make a body of it | [`body_from_mesh`] |
//! | take a body from a command line | [`parse_body`], [`BodySource`] |
//! | build a hierarchy over pieces of any kind | [`build_hierarchy`] |
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
//! assert_eq!(prepared.report.to_string(), "4 pieces, solid");
//! ```

mod body;
mod error;
mod format;
mod hierarchy;
mod mesh;
mod predicates;
mod repair;
mod source;
mod tally;
mod tolerance;
mod topology;

pub use body::{Detail, Prepared, Report, body_from_mesh};
pub use error::{BodyError, MeshError, MeshFault, SourceError};
pub use format::{Format, write_obj};
pub use hierarchy::build_hierarchy;
pub use mesh::TriangleMesh;
pub use repair::Repairs;
pub use source::{BodySource, parse_body};
pub use tally::Tally;
pub use topology::{Edge, Orientation, Topology};
