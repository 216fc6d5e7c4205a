//! The errors of shapes and casts that are refused.

use ccd_core::InputError;

/// The reason why a cast has no answer.
///
/// The functions with parry's signatures convert it to parry's error `Unsupported`, which contains no reason.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CastError {
    /// A shape is refused.
    #[error("shape {shape_number}: {error}")]
    Shape {
        /// The number of the shape: 1 or 2.
        shape_number: u8,
        /// The reason why the shape is refused.
        #[source]
        error: ShapeError,
    },
    /// A motion or a pose is invalid.
    #[error("motion {motion_number}: {error}")]
    Motion {
        /// The number of the motion: 1 or 2.
        motion_number: u8,
        /// The reason why the motion is refused.
        #[source]
        error: InputError,
    },
    /// A number given as a time or a distance is invalid.
    #[error("{what} is {value}, but must be {allowed}")]
    InvalidNumber {
        /// The name of the argument in the function's signature.
        what: &'static str,
        /// The number that was given for the argument.
        value: f64,
        /// The accepted values, in words.
        allowed: &'static str,
    },
    /// Both shapes are half-spaces, which have no nearest points in general.
    #[error("both shapes are half-spaces")]
    BothHalfSpaces,
    /// The interval to be recorded ends before it starts.
    #[error("the interval holds no time: its end is before its start")]
    EmptyInterval,
    /// The engine refuses the scene, for example because it is too large.
    #[error(transparent)]
    Scene(#[from] InputError),
}

impl CastError {
    /// Returns both results, or the first error with the number of its motion.
    pub(crate) fn motions_or_error<T>(
        results: [Result<T, InputError>; 2],
    ) -> Result<[T; 2], CastError> {
        both_or_error(results, |motion_number, error| CastError::Motion {
            motion_number,
            error,
        })
    }

    /// Returns both results, or the first error with the number of its shape.
    pub(crate) fn shapes_or_error<T>(
        results: [Result<T, ShapeError>; 2],
    ) -> Result<[T; 2], CastError> {
        both_or_error(results, |shape_number, error| CastError::Shape {
            shape_number,
            error,
        })
    }
}

fn both_or_error<T, E>(
    [a, b]: [Result<T, E>; 2],
    with_number: fn(u8, E) -> CastError,
) -> Result<[T; 2], CastError> {
    let (a, b) = (
        a.map_err(|error| with_number(1, error)),
        b.map_err(|error| with_number(2, error)),
    );
    Ok([a?, b?])
}

/// The error of a shape from which no body can be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// The type of the shape is not known to this crate.
    #[error("the shape is of a custom type, whose points are not known")]
    CustomShapeType,
    /// A half-space is a part of a compound, or is given where a bounded body is required.
    #[error("a half-space must not be a part of a compound, and cannot become a body")]
    HalfSpace,
    /// A size of the shape is negative, NaN or infinite.
    #[error("its {what} is {value}, but must be at least 0 and finite")]
    InvalidSize {
        /// The name of the size, such as a radius.
        what: &'static str,
        /// The size that parry's shape has.
        value: f64,
    },
    /// A polytope around a round shape would need too many corners.
    #[error(
        "a polytope that exceeds the shape by only {requested_excess} would have too many corners; at least {least_excess} is possible"
    )]
    ExcessTooSmall {
        /// The excess that the options allow, in the scene's unit of length.
        requested_excess: f64,
        /// The least possible excess for this shape, in the scene's unit of length.
        least_excess: f64,
    },
    /// The shape is a cylinder or a cone, which the [options](crate::Excess::NotAllowed) refuse.
    #[error("the shape is a cylinder or a cone, and the options allow no enclosing polytope")]
    SolidOfRevolutionRefused,
    /// An oriented mesh that should be a solid is not closed.
    #[error(
        "the mesh is oriented, but has an edge without a neighbour, from vertex {from} to {other_end_index}"
    )]
    OpenMesh {
        /// The index of one end of the edge.
        from: u32,
        /// The index of the other end.
        other_end_index: u32,
    },
    /// The voxels are too small, too large or too far from the origin for parry to distinguish them.
    #[error("its voxels are too far from the origin, or of a size that is not positive")]
    UnresolvableVoxels,
    /// The shape is a compound of compounds that is nested too deeply.
    #[error(
        "its parts are nested more than {} deep",
        crate::limits::MAX_NESTING_DEPTH
    )]
    NestedTooDeeply,
    /// A part of the compound is refused.
    #[error("part {part}: {error}")]
    Part {
        /// The index of the part in the compound.
        part: u32,
        /// The reason why the part is refused.
        #[source]
        error: Box<ShapeError>,
    },
    /// The engine refuses a piece of the body: a triangle, a voxel or a part.
    #[error("sub-shape {element_index}: {error}")]
    Piece {
        /// The index of the triangle, segment or part; 0 for shapes without indices.
        element_index: u32,
        /// The reason why the engine refuses the piece.
        #[source]
        error: InputError,
    },
    /// The engine refuses the body.
    #[error(transparent)]
    Body(InputError),
}
