//! GJK: a descent in the Minkowski difference of two hulls towards the origin `[GJK88]`.

mod bounds;
mod fan;
mod foot;
mod minkowski;
mod oracle;
mod refine;
mod search;
mod segment;
mod sharpen;
mod simplex;
mod start;
mod termination;
#[cfg(test)]
mod tests;
mod tetrahedron;
mod triangle;

pub use bounds::{DistanceBounds, TerminationBounds, bound_distance};
pub use oracle::Gjk;
pub use simplex::Vertex;
pub use start::Cache;
