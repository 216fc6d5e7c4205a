//! The casts and conversions for one precision of parry's types.

use super::{CONTACT, library};

mod ask;
mod caster;
mod casts;
mod convert;
mod hits;
mod shapes;

pub use caster::Caster;
pub use casts::{cast_shapes, cast_shapes_nonlinear, try_cast_shapes, try_cast_shapes_nonlinear};
pub use convert::motion;
pub use shapes::body;
