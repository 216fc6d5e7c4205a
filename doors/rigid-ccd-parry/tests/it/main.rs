//! Tests casts against parry and against the engine.

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
    use rigid_ccd_parry::f32 as ours;

    /// Numbers for which casts tend to fail, such as zeros, infinities and NaN.
    const SPECIAL_NUMBERS: [f32; 20] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        1e-45,
        -1e-40,
        1e-30,
        1e-7,
        1e-3,
        3.0,
        1e3,
        1e7,
        -1e7,
        1e12,
        1e20,
        3.4e38,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ];

    /// Returns the orientation unchanged: this crate normalises it in double precision.
    pub(crate) fn unit(rotation: library::math::Rotation) -> library::math::Rotation {
        rotation
    }

    #[path = "make.rs"]
    pub(crate) mod make;
    #[path = "odd.rs"]
    mod odd;
}

/// parry's types in double precision.
#[path = ""]
#[allow(clippy::useless_conversion)]
mod double {
    pub(crate) use parry3d_f64 as library;
    use rigid_ccd_parry::f64 as ours;

    /// Numbers for which casts tend to fail, such as zeros, infinities and NaN.
    const SPECIAL_NUMBERS: [f64; 24] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        5e-324,
        -1e-310,
        1e-200,
        1e-100,
        1e-30,
        1e-12,
        1e-3,
        3.0,
        1e3,
        1e7,
        -1e7,
        1e12,
        -1.0000001e12,
        1e100,
        1e200,
        1.7e308,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];

    /// Normalises the orientation, for parry's own arithmetic.
    pub(crate) fn unit(rotation: library::math::Rotation) -> library::math::Rotation {
        rotation.normalize()
    }

    #[path = "make.rs"]
    #[allow(clippy::duplicate_mod)] // Both precisions are one source.
    pub(crate) mod make;
    #[path = "odd.rs"]
    #[allow(clippy::duplicate_mod)] // Both precisions are one source.
    mod odd;
}
