//! Faults of an input. Numerical trouble is an [`Outcome`](crate::Outcome) instead.

use crate::limits::MAX_COORDINATE;
use std::fmt;

/// An invalid input, with the invalid element.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum InputError {
    /// The quantity is NaN or infinite.
    NotFinite {
        /// The name of the quantity.
        what: &'static str,
    },
    /// A quaternion of length zero represents no orientation.
    ZeroQuaternion,
    /// A quantity is out of range.
    OutOfRange {
        /// The name of the quantity.
        what: &'static str,
        /// The value of the quantity.
        value: f64,
        /// The accepted values, in words.
        allowed: &'static str,
    },
    /// A joint is outside of its limits.
    JointPosition {
        /// The joint's index in its chain, if it is in one.
        joint: Option<usize>,
        /// The position.
        position: f64,
        /// The least and the greatest position.
        limits: [f64; 2],
    },
    /// A chain has no such link.
    NoSuchLink {
        /// The link's number.
        link: usize,
        /// The number of joints: links count from 0, the base, to this.
        joints: usize,
    },
    /// A link can be seen only from links nearer to the base, or from itself.
    NotSeenFrom {
        /// The link from which the other is seen.
        from: usize,
        /// The link that is seen.
        link: usize,
    },
    /// Each joint of a chain has a position, fixed ones included.
    JointCount {
        /// The number of positions.
        positions: usize,
        /// The number of joints.
        joints: usize,
    },
    /// A body needs at least one piece.
    NoPieces,
    /// A piece needs at least one point.
    EmptyPiece {
        /// The index of the piece.
        piece: usize,
    },
    /// A point of a piece is NaN, infinite or beyond [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE).
    BadPoint {
        /// The piece's index.
        piece: usize,
        /// The point's index within the piece.
        point: usize,
    },
    /// A rounding radius is negative, NaN, infinite or beyond
    /// [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE).
    BadRadius {
        /// The piece's index.
        piece: usize,
        /// The radius.
        radius: f64,
    },
    /// A face has a vertex index that does not exist.
    VertexOutOfRange {
        /// The face's index.
        face: usize,
        /// The index of the vertex.
        vertex: u32,
        /// The number of vertices.
        vertices: usize,
    },
    /// Every face needs a number.
    FaceIds {
        /// The number of faces.
        faces: usize,
        /// The number of face numbers.
        ids: usize,
    },
    /// A surface must consist of triangles that bound a solid, and belong to a solid body of one piece without
    /// rounding.
    BadSurface,
    /// A facet of a polytope has a corner index that the polytope does not have.
    FacetOutOfRange {
        /// The piece's index.
        piece: usize,
        /// The facet's index within the piece.
        facet: usize,
    },
    /// A face of the mesh on a polytope has a corner that is NaN or infinite.
    BadFace {
        /// The piece's index.
        piece: usize,
        /// The face's index within the piece.
        face: usize,
    },
    /// A hierarchy must hold every piece exactly once, below one root, without cycles.
    BadHierarchy {
        /// The piece or node at which the check fails.
        at: usize,
    },
    /// There are more pieces than an index can name.
    TooManyPieces {
        /// The number of pieces.
        pieces: usize,
    },
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { what } => write!(f, "{what} is NaN or infinite"),
            Self::ZeroQuaternion => write!(f, "a quaternion of length zero names no orientation"),
            Self::OutOfRange {
                what,
                value,
                allowed,
            } => write!(f, "{what} is {}, but must be {allowed}", Short(*value)),
            Self::JointPosition {
                joint,
                position,
                limits: [least, greatest],
            } => {
                match joint {
                    Some(joint) => write!(f, "joint {joint}")?,
                    None => write!(f, "the joint")?,
                }
                let (position, least, greatest) =
                    (Short(*position), Short(*least), Short(*greatest));
                write!(
                    f,
                    " is at {position}, but its limits are {least} and {greatest}"
                )
            }
            Self::NoSuchLink { link, joints } => write!(
                f,
                "there is no link {link}: a chain of {joints} joints has the links 0 to {joints}"
            ),
            Self::NotSeenFrom { from, link } => write!(
                f,
                "link {link} cannot be seen from link {from}, which is farther from the base: see link {from} from \
                 link {link}"
            ),
            Self::JointCount { positions, joints } => write!(
                f,
                "there are {positions} positions of {joints} joints: each joint needs one, fixed ones included"
            ),
            Self::NoPieces => write!(f, "a body needs at least one piece"),
            Self::EmptyPiece { piece } => write!(f, "piece {piece} has no points"),
            Self::BadPoint { piece, point } => write!(
                f,
                "point {point} of piece {piece} has a coordinate that is not within {MAX_COORDINATE:e} of 0"
            ),
            Self::BadRadius { piece, radius } => write!(
                f,
                "the radius of piece {piece} is {}, but must be from 0 to {MAX_COORDINATE:e}",
                Short(*radius)
            ),
            Self::VertexOutOfRange {
                face,
                vertex,
                vertices,
            } => write!(
                f,
                "face {face} names vertex {vertex}, but there are {vertices}"
            ),
            Self::FaceIds { faces, ids } => {
                write!(f, "{faces} faces need as many numbers, not {ids}")
            }
            Self::BadSurface => write!(
                f,
                "a surface has to be solid and of triangles, and its body one solid piece without rounding"
            ),
            Self::FacetOutOfRange { piece, facet } => {
                write!(f, "facet {facet} of piece {piece} names a missing corner")
            }
            Self::BadFace { piece, face } => {
                write!(
                    f,
                    "face {face} of piece {piece} has a corner that is NaN or infinite"
                )
            }
            Self::BadHierarchy { at } => {
                write!(f, "the hierarchy misses, repeats or loops at {at}")
            }
            Self::TooManyPieces { pieces } => write!(f, "{pieces} pieces are too many"),
        }
    }
}

impl std::error::Error for InputError {}

/// Returns an error for a quantity, unless `allowed` holds. The condition has to be false for NaN.
pub(crate) fn check(
    what: &'static str,
    value: f64,
    allowed: bool,
    words: &'static str,
) -> Result<(), InputError> {
    if allowed {
        Ok(())
    } else {
        Err(InputError::OutOfRange {
            what,
            value,
            allowed: words,
        })
    }
}

/// Returns an error for a value that is not a valid length of a shape.
pub(crate) fn check_length(what: &'static str, length: f64) -> Result<(), InputError> {
    let allowed = (0.0..=MAX_COORDINATE).contains(&length);
    check(what, length, allowed, "from 0 to 1e12")
}

/// A number in as few digits as identify it. Very large and very small numbers have a power of ten.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Short(value) = *self;
        // Neither NaN nor an infinity has a power of ten.
        if value == 0.0 || !value.is_finite() || (1e-4..1e7).contains(&value.abs()) {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

#[cfg(test)]
mod tests;
