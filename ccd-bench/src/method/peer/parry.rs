//! Calls parry in double and in single precision from the same source files, since its two crates differ only in their
//! number type.
//!
//! It has two calls for the question, [`double::cast`] and [`double::sweep`], which share no code.

/// The calls of parry in double precision: nonlinear casts and swept triangles.
// Some casts are needed in one precision only.
#[expect(clippy::unnecessary_cast, clippy::useless_conversion)]
#[path = "parry"]
pub mod double {
    use parry3d_f64 as library;

    #[path = "cast.rs"]
    pub mod cast;
    #[path = "shapes.rs"]
    pub mod shapes;
    #[path = "sweep.rs"]
    pub mod sweep;
}

/// The calls of parry in single precision, compiled from the source files of [`double`].
#[path = "parry"]
pub mod single {
    use parry3d as library;

    #[path = "cast.rs"]
    #[expect(clippy::duplicate_mod)]
    pub mod cast;
    #[path = "shapes.rs"]
    #[expect(clippy::duplicate_mod)]
    pub mod shapes;
    #[path = "sweep.rs"]
    #[expect(clippy::duplicate_mod)]
    pub mod sweep;
}
