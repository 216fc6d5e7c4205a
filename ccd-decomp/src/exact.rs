//! Exact predicates on points, segments and triangles: signs that rounding cannot change. They know no mesh.

pub(crate) mod predicates;
pub(crate) mod rays;
pub(crate) mod triangles;
pub(crate) mod volume;
