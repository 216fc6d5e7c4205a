//! parry in both of its precisions, from one source: its two crates differ by their number alone.
//!
//! It has two answers to the question, [`double::cast`] and [`double::sweep`], which share no code.

/// In double precision.
// Casts that one precision does not need, the other one does.
#[expect(clippy::unnecessary_cast, clippy::useless_conversion)]
#[path = "parry"]
pub mod double {
    use parry3d_f64 as library;

    #[path = "cast.rs"]
    pub mod cast;
    #[path = "shapes.rs"]
    pub(in crate::method::peer) mod shapes;
    #[path = "sweep.rs"]
    pub mod sweep;
}

/// In single precision: the same source over the other crate.
#[path = "parry"]
pub mod single {
    use parry3d as library;

    #[path = "cast.rs"]
    #[expect(clippy::duplicate_mod)]
    pub mod cast;
    #[path = "shapes.rs"]
    #[expect(clippy::duplicate_mod)]
    mod shapes;
    #[path = "sweep.rs"]
    #[expect(clippy::duplicate_mod)]
    pub mod sweep;
}
