//! Exact predicates on points, segments and triangles: signs that rounding cannot change.

pub(crate) mod predicates;
pub(crate) mod triangles;
pub(crate) mod volume;
