//! When do two moving rigid bodies first touch? Certified never to be late.
//!
//! A ball falls onto a bracket:
//!
#![cfg_attr(feature = "meshes", doc = "```")]
#![cfg_attr(not(feature = "meshes"), doc = "```ignore")]
//! use rigid_ccd::{Body, Motion, Pose, first_contact, load};
//!
//! let part = load("examples/bracket.obj")?;
//! let ball = Body::ball(0.5)?;
//! let falls = Motion::new(Pose::at([0.0, 0.0, 3.0])?, [0.0, 0.0, -2.0], [0.0; 3])?;
//! if let Some(hit) = first_contact((&ball, falls), (&part, Motion::STILL), 1.0)? {
//!     println!("contact at {} in {}", hit.time, hit.witness_b);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | to … | use |
//! |---|---|
//! | ask one question | [`first_contact`] |
//! | ask many | [`Solver`], one for each thread |
//! | choose the tolerance, a margin, a budget, a deadline | [`Solver::with_config`] |
//! | make a body | [`Body::ball`], [`Body::capsule`], [`Body::cuboid`], `load` for a file |
//! | make one of vertices and faces in memory | `mesh::TriangleMesh::new`, then `mesh::body_from_mesh`; or [`Pieces::triangles`] |
//! | move it | [`Motion::new`], [`Motion::between`] |
//! | list all features in contact | [`Problem::contacts_at`] |
//! | see what was proven, and what that took | [`Solver::answer`] |
//! | choose a distance backend, or bring one | [`Solver::with_oracle`], [`DistanceOracle`] |
//!
//! Vectors are arrays, or whatever turns into them: those of `glam` and `nalgebra`.
//!
//! # Guarantee
//! No contact happens before the time of a [`Hit`], and none at all where there is no hit: for every
//! mesh, motion and backend, in floating point. A query that reaches a limit is an [`Error`], which
//! carries a time before which nothing touches. What [`StartPolicy::Leave`] lets go of at the start does
//! not count.
//!
//! # Features
//! - `meshes` (default): `load`, and `mesh` for all that `ccd-decomp` does with meshes. It takes
//!   four fifths of the time to build.
//! - `vmarch`: the distance backend `Vmarch`.
//! - `nalgebra`: conversions between [`Pose`] and `nalgebra::Isometry3<f64>`.

#[cfg(feature = "command")]
pub mod batch;
#[cfg(feature = "command")]
pub mod command;
mod error;
mod hit;
#[cfg(feature = "meshes")]
mod load;
mod solver;
#[cfg(feature = "command")]
pub mod table;
#[cfg(feature = "command")]
mod text;

pub use ccd_core::glam;
pub use ccd_core::schedule;
pub use ccd_core::{
    Answer, Body, Claim, Combination, Config, Contact, ContactsError, DistanceOracle, Effort, Face,
    Facet, Feature, FeaturePair, Frame, GiveUp, Hierarchy, HierarchyNode, InputError, Limit,
    Motion, Moving, OrElse, Origin, Outcome, Overlap, Piece, PiecePair, Pieces, Polytope, Pose,
    Problem, Schedule, Separation, StartPolicy, Stats, Volume,
};
/// Meshes, and what they are made into.
#[cfg(feature = "meshes")]
pub use ccd_decomp as mesh;
#[cfg(feature = "meshes")]
pub use ccd_decomp::BodyError;
pub use ccd_distance_gjk::{ClosedForm, Direct, Gjk};
#[cfg(feature = "vmarch")]
pub use ccd_distance_vmarch::Vmarch;
pub use error::Error;
pub use hit::{Hit, HitKind};
#[cfg(feature = "meshes")]
pub use load::load;
pub use solver::{Solver, first_contact};
