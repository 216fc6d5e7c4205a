//! Certified continuous collision detection: when do two moving rigid bodies first touch?
//!
//! A ball falls onto a bracket:
//!
#![cfg_attr(feature = "meshes", doc = "```")]
#![cfg_attr(not(feature = "meshes"), doc = "```ignore")]
//! use rigid_ccd::{Body, Motion, Pose, first_contact, load};
//!
//! let part = load("examples/bracket.obj")?;
//! let ball = Body::sphere(0.5)?;
//! let falls = Motion::new(Pose::at([0.0, 0.0, 3.0])?, [0.0, 0.0, -2.0], [0.0; 3])?;
//! if let Some(hit) = first_contact((&ball, falls), (&part, Motion::STILL), 1.0)?.hit()? {
//!     println!("contact at {} in {}", hit.time, hit.witness_b());
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | to … | use |
//! |---|---|
//! | answer one query | [`first_contact`] |
//! | ask only whether two bodies stay apart | [`Solver::is_free`] |
//! | ask how close they come, and when | [`Solver::closest_approach`], [`Solver::distance`] at rest |
//! | ask from when until when they are in contact | [`Solver::contact_interval`] |
//! | follow a spline, a path of poses, a throw, an arm's link | [`trajectory`] |
//! | answer many on all cores, in order | [`first_contacts`], [`ParallelSolver`] |
//! | answer many one after another | [`Solver`] |
//! | move many bodies, and find who touches whom first, or at all | [`Scene`] |
//! | set a tolerance, a margin, a budget or a deadline | [`Settings`], [`Solver::with_settings`] |
//! | make a body | [`Body::sphere`], [`Body::capsule`], [`Body::cuboid`], [`Body::cylinder`], [`Body::cone`], [`load`] for a file |
//! | make a body of each part of a file, convert units, scale or mirror it | [`load_parts`], [`load_in_unit`], [`load_adjusted`], [`mesh::MeshFile`] |
//! | make a body from vertices and faces in memory | [`mesh::TriangleMesh::new`], then [`mesh::body_from_mesh`]; or [`body::Pieces::from_triangles`] |
//! | move a body | [`Motion::new`], [`Motion::between`] |
//! | list all features in contact | [`Query::contacts_at`] |
//! | choose the question at run time | [`Question`], [`Solver::answer`] |
//! | read an answer's bounds, limits and cost | [`answer`] |
//! | choose or write a distance backend | [`Solver::with_oracle`], [`oracle`] |
//!
//! Vectors are arrays, or types that convert into them: those of [`glam`] and `nalgebra`. Lengths are in
//! any one unit, times in the motions' unit, angles in radians.
//!
//! # Terms
//! - A *piece* is a convex part of a body: the convex hull of a few points, rounded by a radius. A ball
//!   is one point with a radius, a box one piece of eight points; a mesh is many pieces, often one for
//!   each triangle.
//! - A *distance backend* ([`oracle::DistanceOracle`]) computes the distance of two pieces. The engine checks
//!   each result before it uses it, so a wrong backend makes a query slow or unresolved, never wrong.
//!   The default, [`oracle::Direct`], suits all bodies.
//! - A contact is a distance of at most margin + *tolerance*. The *margin* is a distance to keep,
//!   0 by default.
//! - *Witnesses* are a pair of nearest points of the two bodies.
//!
//! # Guarantee
//! No contact happens before the time of a [`Hit`]. Without a hit, no contact happens within the
//! duration. This holds
//! for every mesh, motion and backend, in floating point. A query that reaches a limit is an [`Error`]
//! with a time before which no contact happens. Contacts at the start that [`StartPolicy::Leave`] ignores
//! do not count.
//!
//! # Features
//! - `meshes` (default): [`load`], and [`mesh`] for everything that `ccd-decomp` does with meshes.
//! - `gltf`: meshes from files of this format, too.
//! - `scenes` (default): [`Scene`], many moving bodies.
//! - `vmarch`: the distance backend [`oracle::Vmarch`].
//! - `nalgebra`: conversions between [`Pose`] and `nalgebra::Isometry3<f64>`.
//!
//! The README of this crate lists the time that each feature takes to build.
//!
// In documentation without a feature, the names that need it link to the list of features.
#![cfg_attr(feature = "meshes", doc = "[`load`]: load()")]
#![cfg_attr(
    not(feature = "meshes"),
    doc = "[`load`]: #features
[`load_in_unit`]: #features
[`load_adjusted`]: #features
[`load_parts`]: #features
[`mesh`]: #features
[`mesh::MeshFile`]: #features
[`mesh::TriangleMesh::new`]: #features
[`mesh::body_from_mesh`]: #features"
)]
#![cfg_attr(not(feature = "scenes"), doc = "[`Scene`]: #features")]
#![cfg_attr(not(feature = "vmarch"), doc = "[`oracle::Vmarch`]: #features")]

pub mod answer;
pub mod body;
mod error;
#[cfg(feature = "meshes")]
mod load;
pub mod oracle;
mod parallel;
mod remark;
#[cfg(feature = "scenes")]
pub mod scene;
mod solver;
pub mod text;
pub mod trajectory;

pub use ccd_core::glam;
pub use ccd_core::schedule;
pub use ccd_core::{
    Answer, Body, ContactNormals, Hit, InputError, Motion, Outcome, Pose, Query, Question, Setting,
    SettingField, Settings, StartPolicy,
};
/// Meshes, and bodies made from them.
#[cfg(feature = "meshes")]
pub use ccd_decomp as mesh;
pub use error::Error;
#[cfg(feature = "meshes")]
pub use load::{load, load_adjusted, load_in_unit, load_parts};
#[doc(hidden)]
pub use parallel::CachePadded;
pub use parallel::{ParallelSolver, first_contacts};
pub use remark::Remark;
#[cfg(feature = "scenes")]
pub use scene::Scene;
pub use solver::{Solver, first_contact};

/// The example in the README, run as a doctest.
#[cfg(all(doctest, feature = "meshes"))]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;
