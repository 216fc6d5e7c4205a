//! Errors of describing and loading bodies.

use crate::file::error::StoreError;
use crate::mesh::adjustments::UnknownAdjustment;
use crate::mesh::error::MeshError;
use crate::prepare::error::PrepareError;
use ccd_core::InputError;
use ccd_core::limits::MAX_COORDINATE;
use std::path::PathBuf;

/// The reason why a body cannot be created from a description.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// The text describes no body.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// The mesh cannot be read.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The stored body cannot be read.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The core rejects the shape.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The mesh cannot be made into a body.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// The content of a file cannot be made into a body.
    #[error("{}: {error}", .file.display())]
    InFile {
        /// The file.
        file: PathBuf,
        /// The reason.
        error: PrepareError,
    },
}

/// A text that describes no body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SourceError {
    /// The text is empty.
    #[error("no body given; {EXAMPLES}")]
    Empty,
    /// The word before the colon is not a known shape.
    #[error("there is no shape {shape:?}; {EXAMPLES}")]
    UnknownShape {
        /// The word.
        shape: String,
    },
    /// A shape needs another number of lengths.
    #[error(
        "{shape:?} takes {expected} length{}, not {given}; {EXAMPLES}",
        if *.expected == 1 { "" } else { "s" }
    )]
    WrongCount {
        /// The shape.
        shape: &'static str,
        /// The number that it takes.
        expected: usize,
        /// The number given.
        given: usize,
    },
    /// The text after a file name is no adjustment.
    #[error(transparent)]
    Adjustment(#[from] UnknownAdjustment),
    /// Adjustments do not apply to a stored body.
    #[error("{}: {PREPARED}", .file.display())]
    Prepared {
        /// The file.
        file: PathBuf,
    },
    /// A length is beyond the largest coordinate.
    #[error(
        "{length:?} is too large a length of {shape:?}: lengths are from 0 to {MAX_COORDINATE:e}; use a larger unit of length"
    )]
    TooLong {
        /// The shape.
        shape: &'static str,
        /// The text given for the length.
        length: String,
    },
    /// A length is not a finite number of at least 0.
    #[error(
        "{length:?} is not a length of {shape:?}: a number from 0 to {MAX_COORDINATE:e}; {EXAMPLES}"
    )]
    BadLength {
        /// The shape.
        shape: &'static str,
        /// The text given for the length.
        length: String,
    },
}

const PREPARED: &str = "a prepared body has its unit, size and pieces already; use the mesh it was made from, or \
                        prepare it with the adjustments";

const EXAMPLES: &str = "use box:1,2,3 (half extents), sphere:0.5 (radius), capsule:0.2,1 (radius, \
                        half height), cylinder:0.2,1 or cone:0.2,1 (the same), a file such as part.obj, a part \
                        of one such as scene.glb#lid, or a file with adjustments such as part.stl@mm";
