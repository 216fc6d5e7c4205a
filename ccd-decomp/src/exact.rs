//! Exact geometric predicates on points, segments and triangles.

pub(crate) mod predicates;
pub(crate) mod rays;
pub(crate) mod triangles;
pub(crate) mod volume;
