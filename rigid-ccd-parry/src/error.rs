//! What is refused, and why.

use ccd_core::InputError;

/// A cast that has no answer.
///
/// parry's error, `Unsupported`, tells nothing. It is made from this one, by the functions with parry's signatures.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CastError {
    /// A shape is refused.
    #[error("shape {which}: {error}")]
    Shape {
        /// 1 or 2.
        which: u8,
        /// The reason.
        #[source]
        error: ShapeError,
    },
    /// A motion or a pose is refused.
    #[error("motion {which}: {error}")]
    Motion {
        /// 1 or 2.
        which: u8,
        /// The reason.
        #[source]
        error: InputError,
    },
    /// A time or a distance is refused.
    #[error("{what} is {value}, but must be {allowed}")]
    Number {
        /// The argument.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The accepted values, in words.
        allowed: &'static str,
    },
    /// Two half-spaces, which have no nearest points in general.
    #[error("both shapes are half-spaces")]
    HalfSpaces,
    /// An interval without time has nothing to record.
    #[error("the interval holds no time: its end is before its start")]
    NoTime,
    /// The engine refuses the scene: it is too large, for instance.
    #[error(transparent)]
    Scene(#[from] InputError),
}

/// A shape that no body is made of.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A shape of a type that is not known here.
    #[error("the shape is of a custom type, whose points are not known")]
    Custom,
    /// A half-space as a part, or where a bounded body is needed.
    #[error("a half-space is served alone only, and not as a body")]
    HalfSpace,
    /// A size that is negative, NaN or infinite.
    #[error("its {what} is {value}, but must be at least 0 and finite")]
    Size {
        /// The size.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A polytope about a round shape would have too many corners.
    #[error(
        "a polytope about it that exceeds it by only {asked} would have too many corners; {least} can be had"
    )]
    Excess {
        /// The excess that was asked for.
        asked: f64,
        /// The least excess that can be had for this shape.
        least: f64,
    },
    /// Cylinders and cones are refused by the [options](crate::Excess::Refuse).
    #[error("it is a cylinder or a cone, for which the options allow no polytope about it")]
    Round,
    /// An oriented mesh that is to be a solid is not closed.
    #[error(
        "the mesh is oriented, but has an edge without a neighbour, from vertex {from} to {to}"
    )]
    Open {
        /// The number of one end of the edge.
        from: u32,
        /// The number of the other end.
        to: u32,
    },
    /// Voxels of a size or at places that parry itself does not tell apart.
    #[error("its voxels are too far from the origin, or of a size that is not positive")]
    Grid,
    /// Compounds within compounds, too deep.
    #[error("its parts are nested more than {} deep", crate::limits::DEEPEST)]
    Nested,
    /// A part of a compound.
    #[error("part {part}: {error}")]
    Part {
        /// The part's number.
        part: u32,
        /// The reason.
        #[source]
        error: Box<ShapeError>,
    },
    /// The engine refuses a piece of the body: a triangle, a voxel, a part.
    #[error("sub-shape {number}: {error}")]
    Piece {
        /// The number of the triangle, segment or part; 0 for shapes that have none.
        number: u32,
        /// The reason.
        #[source]
        error: InputError,
    },
    /// The engine refuses the body.
    #[error(transparent)]
    Body(InputError),
}
