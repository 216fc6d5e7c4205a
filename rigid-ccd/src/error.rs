//! The error type of single queries.

use ccd_core::{InputError, Unresolved};
#[cfg(feature = "meshes")]
use ccd_decomp::{BodyError, PrepareError};

/// The error of a query: invalid input, an invalid body, or a limit that was reached.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The input is not valid, such as a coordinate that is not finite or a negative duration.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A body cannot be made, from a file for instance.
    #[cfg(feature = "meshes")]
    #[error(transparent)]
    Body(#[from] BodyError),
    /// A limit of work or time was reached before the query had an answer.
    #[error(transparent)]
    Unresolved(#[from] Unresolved),
}

#[cfg(feature = "meshes")]
impl From<PrepareError> for Error {
    fn from(error: PrepareError) -> Self {
        Error::Body(error.into())
    }
}
