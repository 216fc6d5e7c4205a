//! Certified continuous collision detection for rigid bodies.
#![doc = "WIP"]

mod body;
mod containment;
mod error;
mod feature;
mod hierarchy;
mod motion;
pub mod motion_bound;
mod oracle;
mod outcome;
mod overlap;
mod path;
mod piece;
mod pieces;
mod pose;
mod primitive;
mod problem;
pub mod schedule;
mod separation;
mod shell;
#[cfg(test)]
mod tests;
pub mod tolerance;
mod tree;

pub use body::{Body, Volume};
pub use error::InputError;
pub use feature::Feature;
pub use glam;
pub use hierarchy::{Hierarchy, HierarchyNode};
pub use motion::Motion;
pub use oracle::{Claim, Combination, DistanceOracle, GiveUp, OrElse, PiecePair};
pub use outcome::{Answer, Contact, Limit, Outcome, Overlap, Separation, Stats};
pub use piece::{Facet, Facets, Piece, Polytope};
pub use pieces::Pieces;
pub use pose::{Frame, Pose};
pub use problem::{Config, Moving, Problem, StartPolicy};
pub use schedule::Schedule;
