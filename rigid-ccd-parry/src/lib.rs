//! Certified shape casts for parry and rapier: parry's signatures, and answers that are never late.

mod cast;
mod closed;
mod enclosure;
mod error;
mod form;
mod half_space;
mod horizon;
mod interval;
mod leaving;
pub mod limits;
mod order;
mod prepared;
mod scene;
mod settings;
mod shelf;
mod tolerance;

pub use error::{CastError, ShapeError};
pub use prepared::Prepared;
pub use settings::{Excess, Meshes, Settings};

/// For `parry3d`, in single precision.
#[cfg(feature = "f32")]
#[allow(clippy::duplicate_mod)] // Both precisions are one source.
#[path = "precision"]
pub mod f32 {
    macro_rules! parry {
        () => {
            "parry3d"
        };
    }
    macro_rules! precision {
        () => {
            "f32"
        };
    }
    pub(crate) use crate::tolerance::CONTACT_F32 as CONTACT;
    pub(crate) use parry3d as library;

    mod ask;
    mod caster;
    mod casts;
    mod convert;
    mod hits;
    mod shapes;

    pub use caster::Caster;
    pub use casts::{
        cast_shapes, cast_shapes_nonlinear, try_cast_shapes, try_cast_shapes_nonlinear,
    };
    pub use convert::motion;
    pub use shapes::body;
}

/// For `parry3d-f64`, in double precision.
#[cfg(feature = "f64")]
// Both precisions are one source. Some conversions are needed in the other one only.
#[allow(
    clippy::duplicate_mod,
    clippy::unnecessary_cast,
    clippy::useless_conversion
)]
#[path = "precision"]
pub mod f64 {
    macro_rules! parry {
        () => {
            "parry3d_f64"
        };
    }
    macro_rules! precision {
        () => {
            "f64"
        };
    }
    pub(crate) use crate::tolerance::CONTACT_F64 as CONTACT;
    pub(crate) use parry3d_f64 as library;

    mod ask;
    mod caster;
    mod casts;
    mod convert;
    mod hits;
    mod shapes;

    pub use caster::Caster;
    pub use casts::{
        cast_shapes, cast_shapes_nonlinear, try_cast_shapes, try_cast_shapes_nonlinear,
    };
    pub use convert::motion;
    pub use shapes::body;
}
