//! Errors of a query.

use ccd_core::{InputError, Limit};
#[cfg(feature = "meshes")]
use ccd_decomp::{BodyError, PrepareError};

/// The error of a query.
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
    /// A limit was reached first: whether the bodies touch after `safe_until` is not known.
    #[error("unresolved ({reason}): no contact before time {safe_until}, not known after")]
    Unresolved {
        /// The time before which no contact happens, certified, in the motions' unit of time.
        safe_until: f64,
        /// The limit that was reached.
        reason: Limit,
    },
}

#[cfg(feature = "meshes")]
impl From<PrepareError> for Error {
    fn from(error: PrepareError) -> Self {
        Error::Body(error.into())
    }
}
