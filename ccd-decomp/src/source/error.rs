//! Errors of descriptions of bodies.

use crate::load::error::AdjustedStoredBody;
use crate::mesh::adjustments::UnknownAdjustment;
use ccd_core::limits::MAX_COORDINATE;

/// The error for a text that does not describe a body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SourceError {
    /// The text that describes the body is empty.
    #[error("no body given; {USAGE_EXAMPLES}")]
    Empty,
    /// The text has the form `shape:lengths`, but no shape has that name.
    #[error("there is no shape {shape:?}; {USAGE_EXAMPLES}")]
    UnknownShape {
        /// The word before the colon.
        shape: String,
    },
    /// A shape has too many or too few lengths.
    #[error(
        "{shape:?} takes {expected_count} length{}, not {given_count}; {USAGE_EXAMPLES}",
        if *.expected_count == 1 { "" } else { "s" }
    )]
    WrongLengthCount {
        /// The name of the shape.
        shape: &'static str,
        /// The number of lengths that the shape takes.
        expected_count: usize,
        /// The number of lengths that the text has.
        given_count: usize,
    },
    /// A word after the file name is not an adjustment.
    #[error(transparent)]
    UnknownAdjustment(#[from] UnknownAdjustment),
    /// A stored body has adjustments.
    #[error(transparent)]
    AdjustedStoredBody(#[from] AdjustedStoredBody),
    /// A length exceeds the largest supported coordinate.
    #[error(
        "{length:?} is too large a length of {shape:?}: lengths are from 0 to {MAX_COORDINATE:e}; use a larger unit of length"
    )]
    LengthTooLarge {
        /// The name of the shape.
        shape: &'static str,
        /// The length as written in the text.
        length: String,
    },
    /// A length is not a finite number of at least 0.
    #[error(
        "{length:?} is not a length of {shape:?}: a number from 0 to {MAX_COORDINATE:e}; {USAGE_EXAMPLES}"
    )]
    BadLength {
        /// The name of the shape.
        shape: &'static str,
        /// The length as written in the text.
        length: String,
    },
}

const USAGE_EXAMPLES: &str = "use box:1,2,3 (half extents), sphere:0.5 (radius), capsule:0.2,1 (radius, \
                        half height), cylinder:0.2,1 or cone:0.2,1 (the same), a file such as part.obj, a part \
                        of one such as scene.glb#lid, or a file with adjustments such as part.stl@mm";
