//! The casts beside parry, and beside the engine itself.

mod agree;
mod apart;
mod frames;
mod geometry;
mod half_spaces;
mod hostile;
mod nested;
mod options;
mod parting;
mod poses;
mod scenes;

/// parry's types in single precision.
#[path = ""]
#[allow(clippy::useless_conversion)] // Some conversions are needed in the other precision only.
mod single {
    pub(crate) use parry3d as library;

    /// Orientations stay as they are given: this crate makes them units in double precision.
    pub(crate) fn unit(rotation: library::math::Rotation) -> library::math::Rotation {
        rotation
    }

    #[path = "make.rs"]
    pub(crate) mod make;
}

/// parry's types in double precision.
#[path = ""]
#[allow(clippy::useless_conversion)]
mod double {
    pub(crate) use parry3d_f64 as library;

    /// Orientations are units, for parry's own arithmetic.
    pub(crate) fn unit(rotation: library::math::Rotation) -> library::math::Rotation {
        rotation.normalize()
    }

    #[path = "make.rs"]
    #[allow(clippy::duplicate_mod)] // Both precisions are one source.
    pub(crate) mod make;
}
