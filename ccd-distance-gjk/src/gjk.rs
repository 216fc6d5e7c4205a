//! GJK: descends the Minkowski difference of two hulls towards the origin `[GJK88]`.

mod fan;
mod minkowski;
mod oracle;
mod refine;
mod rounded;
mod search;
mod segment;
mod sharpen;
mod simplex;
mod single;
mod start;
mod termination;
#[cfg(test)]
mod tests;
mod tetrahedron;
mod triangle;
mod vector;

pub use oracle::Gjk;
pub use single::GjkF32;
pub use start::Cache;
