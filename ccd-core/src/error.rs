//! Errors for invalid input. Numerical trouble is an [`Outcome`](crate::Outcome) instead.

use crate::limits::MAX_COORDINATE;
use std::fmt;

/// The reason why an input is invalid, with the invalid element.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum InputError {
    /// A quantity is NaN or infinite.
    NotFinite {
        /// The name of the quantity that is not finite.
        quantity: &'static str,
    },
    /// A quaternion has length zero, and represents no orientation.
    ZeroQuaternion,
    /// A quantity is outside of its accepted range.
    OutOfRange {
        /// The name of the quantity that is out of range.
        quantity: &'static str,
        /// The rejected value of the quantity.
        value: f64,
        /// The accepted values, described in words.
        allowed: &'static str,
    },
    /// The position of a joint is outside of the joint's limits.
    JointOutOfLimits {
        /// The index of the joint in its chain, if it is in one.
        joint: Option<usize>,
        /// The requested position of the joint.
        joint_position: f64,
        /// The least and the greatest accepted position.
        limits: [f64; 2],
    },
    /// A link number is greater than the number of joints of the chain.
    NoSuchLink {
        /// The requested number of the link.
        link: usize,
        /// The number of joints of the chain, which is also the number of its last link; link 0 is the base.
        joint_count: usize,
    },
    /// A link's motion was requested relative to a link that is farther from the base.
    ReferenceLinkTooFar {
        /// The number of the link that serves as reference.
        from: usize,
        /// The number of the link whose motion was requested.
        link: usize,
    },
    /// The number of positions differs from the number of joints. Each joint needs one, fixed ones included.
    JointCountMismatch {
        /// The number of given positions.
        positions: usize,
        /// The number of joints in the chain.
        joints: usize,
    },
    /// A body has no pieces.
    NoPieces,
    /// A piece has no points.
    EmptyPiece {
        /// The index of the piece without points.
        piece: usize,
    },
    /// A point of a piece is NaN, infinite or beyond [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE).
    BadPoint {
        /// The index of the piece with the invalid point.
        piece: usize,
        /// The index of the invalid point within the piece.
        point: usize,
    },
    /// A rounding radius is negative, NaN, infinite or beyond
    /// [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE).
    BadRadius {
        /// The index of the piece with the invalid radius.
        piece: usize,
        /// The invalid radius.
        radius: f64,
    },
    /// A face refers to a vertex that does not exist.
    VertexOutOfRange {
        /// The index of the face that refers to the vertex.
        face: usize,
        /// The index of the missing vertex.
        vertex: u32,
        /// The number of vertices in the mesh.
        vertices: usize,
    },
    /// The number of face numbers differs from the number of faces.
    FaceIdCountMismatch {
        /// The number of faces in the mesh.
        faces: usize,
        /// The length of the list of face numbers.
        id_count: usize,
    },
    /// A surface does not consist of triangles that bound a solid, or does not belong to a solid body of one piece with
    /// radius 0.
    BadSurface,
    /// A facet of a polytope refers to a point that does not exist.
    FacetOutOfRange {
        /// The index of the piece with the invalid facet.
        piece: usize,
        /// The index of the invalid facet within the piece.
        facet: usize,
    },
    /// A face of the mesh on a polytope has a corner that is NaN or infinite.
    BadFace {
        /// The index of the piece with the invalid face.
        piece: usize,
        /// The index of the invalid face within the piece.
        face: usize,
    },
    /// A hierarchy is not a tree with one root in which every piece occurs exactly once.
    BadHierarchy {
        /// The index of the piece or node at which the check fails.
        index: usize,
    },
    /// There are more pieces than indices of 32 bits can number.
    TooManyPieces {
        /// The number of given pieces.
        pieces: usize,
    },
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { quantity } => write!(f, "{quantity} is NaN or infinite"),
            Self::ZeroQuaternion => write!(f, "a quaternion of length zero names no orientation"),
            Self::OutOfRange {
                quantity,
                value,
                allowed,
            } => {
                let value = ShortNumber(*value);
                write!(f, "{quantity} is {value}, but must be {allowed}")
            }
            Self::JointOutOfLimits {
                joint,
                joint_position: position,
                limits: [least, greatest],
            } => {
                match joint {
                    Some(joint) => write!(f, "joint {joint}")?,
                    None => write!(f, "the joint")?,
                }
                let [position, least, greatest] = [*position, *least, *greatest].map(ShortNumber);
                write!(
                    f,
                    " is at {position}, but its limits are {least} and {greatest}"
                )
            }
            Self::NoSuchLink {
                link,
                joint_count: joints,
            } => write!(
                f,
                "there is no link {link}: a chain of {joints} joints has the links 0 to {joints}"
            ),
            Self::ReferenceLinkTooFar { from, link } => write!(
                f,
                "link {link} cannot be seen from link {from}, which is farther from the base: see link {from} from \
                 link {link}"
            ),
            Self::JointCountMismatch { positions, joints } => write!(
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
                ShortNumber(*radius)
            ),
            Self::VertexOutOfRange {
                face,
                vertex,
                vertices,
            } => write!(
                f,
                "face {face} names vertex {vertex}, but there are {vertices}"
            ),
            Self::FaceIdCountMismatch {
                faces,
                id_count: ids,
            } => {
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
            Self::BadHierarchy { index: at } => {
                write!(f, "the hierarchy misses, repeats or loops at {at}")
            }
            Self::TooManyPieces { pieces } => write!(f, "{pieces} pieces are too many"),
        }
    }
}

impl std::error::Error for InputError {}

/// Returns an error for a quantity unless `is_allowed` is true. The condition has to be false for NaN.
pub fn check(
    quantity: &'static str,
    value: f64,
    is_allowed: bool,
    allowed: &'static str,
) -> Result<(), InputError> {
    is_allowed.then_some(()).ok_or(InputError::OutOfRange {
        quantity,
        value,
        allowed,
    })
}

/// Returns an error for a quantity unless it is finite.
pub fn check_finite(quantity: &'static str, is_finite: bool) -> Result<(), InputError> {
    let finite = is_finite.then_some(());
    finite.ok_or(InputError::NotFinite { quantity })
}

/// Returns an error unless a value is a valid length of a shape.
pub(crate) fn check_shape_length(what: &'static str, length: f64) -> Result<(), InputError> {
    let allowed = (0.0..=MAX_COORDINATE).contains(&length);
    check(what, length, allowed, "from 0 to 1e12")
}

/// Displays a number with as few digits as identify it, and with a power of ten if it is very large or very small.
#[derive(Clone, Copy)]
pub struct ShortNumber(pub f64);

impl fmt::Display for ShortNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ShortNumber(value) = *self;
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
