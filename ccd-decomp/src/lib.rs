//! Turns meshes into bodies for `ccd-core`: readers, checks, repairs, convex pieces and hierarchies.
//!
//! | to … | see |
//! |---|---|
//! | read OBJ, STL, PLY, OFF, glTF or COLLADA | [`TriangleMesh::read`], [`Format`] |
//! | read the parts of a file, convert units | [`MeshFile`], [`Unit`] |
//! | move, join and measure meshes | [`TriangleMesh::transformed`], [`TriangleMesh::merge`], [`TriangleMesh::bounding_box`] |
//! | find the faults of a mesh, and skipped content | [`Repairs`], [`Remarks`], [`TopologyDefects`], [`MeshFault`] |
//! | make a body of a mesh | [`body_from_mesh`], [`PieceChoice`], [`Report`] |
//! | decompose its surface exactly | [`decompose`], [`Decomposition`] |
//! | store a prepared body, and load it | [`prepare`](fn@prepare), [`StoredBodyContent::save`], [`StoredBodyContent::load`] |
//! | load a body from a file, or a part of one | [`load_body`], [`MeshSource`] |
//! | take a body from a command line | [`BodySource`] |
//! | build a hierarchy, or a tree of hulls, over pieces of any kind | [`build_hierarchy`], [`build_hull_tree`] |
//!
//! # Example
//! A body inside this part does not touch it, because the part is not solid. The report names the edges of the hole.
//!
//! ```
//! use ccd_decomp::{PieceChoice, Format, TriangleMesh, body_from_mesh};
//! let file = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";
//! let mesh = TriangleMesh::from_reader(Format::Obj, file.as_bytes())?;
//! let report = body_from_mesh(&mesh, PieceChoice::Auto)?.report;
//! assert_eq!(
//!     report.to_string(),
//!     "3 triangles, surface only (open; edges with one face: 3 (e0-2, e0-3, e2-3))"
//! );
//!
//! // The three edges are the rim of a hole. A face closes it, and the body is solid.
//! let faces = [mesh.faces(), &[[2, 0, 3]]].concat();
//! let closed = TriangleMesh::new(mesh.vertices().to_vec(), &faces)?;
//! let report = body_from_mesh(&closed, PieceChoice::Auto)?.report;
//! assert_eq!(report.to_string(), "1 convex hull, solid");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Guarantee
//! No repair removes a point of the surface: a dropped face lies on a face that is kept, so that a query on the body
//! finds every contact that the file's own faces would have. Faces and vertices keep the numbers that they have in
//! the file, from 0; in a scene of parts, those of one part follow those of another.
//!
//! # Features
//! - `collada`: COLLADA 1.4 and 1.5, `.dae`. One crate.
//! - `gltf`: glTF 2.0, `.gltf` and `.glb`. Five crates.
//!
//! # Layers
//! Each module uses only those below it, and has its own errors.
//!
//! | module | holds |
//! |---|---|
//! | `load` | bodies from files |
//! | `source` | bodies by their description on a command line |
//! | `file` | stored bodies, the OBJ writers, [`StoreError`] |
//! | `prepare` | the model of a mesh: choice of pieces, report, [`PrepareError`] |
//! | `tree` | hierarchies and hull trees over pieces, [`HullTreeBuildError`] |
//! | `pieces` | a mesh in convex pieces: the solid itself, patches of its surface, or its outer hull |
//! | `solid` | whether a mesh bounds a solid: edges, shells, intersecting faces, [`DecomposeError`] |
//! | `mesh` | triangle meshes: file formats, repairs, [`MeshError`] |
//! | `search` | trees of oriented boxes over triangles |
//! | `ellipsoid` | convex polytopes about ellipsoids |
//! | `hull` | convex hulls of points, exact, [`HullError`] |
//! | `exact` | exact predicates |
//! | `tolerance`, `work`, `tally`, `bounds`, `half_edges`, `disjoint_sets`, `messages` | constants, budgets, counts, boxes, edges, sets, error messages |

mod bounds;
mod disjoint_sets;
mod ellipsoid;
mod exact;
mod file;
mod half_edges;
mod hull;
mod load;
mod mesh;
mod messages;
mod pieces;
mod prepare;
#[cfg(test)]
#[path = "../../ccd-core/src/tests/rational.rs"]
mod rational;
mod search;
mod solid;
mod source;
mod tally;
#[cfg(test)]
mod test_files;
#[cfg(test)]
mod test_meshes;
mod tolerance;
mod tree;
mod work;
#[cfg(test)]
#[allow(dead_code)]
#[path = "../../ccd-core/src/tests/worst.rs"]
mod worst;

pub use ellipsoid::ellipsoid;
pub use file::STORED_BODY_EXTENSION;
pub use file::error::{StoreError, StoreFault};
pub use file::obj::{write_obj, write_obj_pieces};
pub use hull::{HullError, hull as convex_hull};
pub use load::error::{AdjustedStoredBody, BodyError};
pub use load::load_body;
pub use load::mesh_source::MeshSource;
pub use mesh::TriangleMesh;
pub use mesh::adjustments::{Adjustments, Axis, UnknownAdjustment};
pub use mesh::affine::AffineMap;
pub use mesh::error::{MeshError, MeshFault};
pub use mesh::format::Format;
pub use mesh::mesh_file::{MeshFile, NamedMesh};
pub use mesh::remark::{DIVIDED_VERTICES, Remark, Remarks};
pub use mesh::repair::Repairs;
pub use mesh::unit::{Unit, UnknownUnit};
pub use messages::{FileError, HTML_ADVICE, is_html};
pub use pieces::patches::{Decomposition, Patch, PatchOrder, decompose};
pub use prepare::error::PrepareError;
pub use prepare::model::{PreparedBody, StoredBodyContent};
pub use prepare::report::{EstimatedQueryTimes, PieceReason, PiecesKind, Report};
pub use prepare::{PieceChoice, body_from_mesh, prepare};
pub use solid::error::{Crossing, DecomposeError};
pub use solid::topology::{Edge, TopologyDefects};
pub use source::BodySource;
pub use source::error::SourceError;
pub use tally::CountWithExamples;
pub use tree::hierarchy::build_hierarchy;
pub use tree::hull_tree::{HullTreeBuildError, build_hull_tree};
