//! Why a question has no answer.

use ccd_core::{InputError, Limit};
#[cfg(feature = "meshes")]
use ccd_decomp::{BodyError, PrepareError};

/// Why a question has no answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The question cannot be asked.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A body cannot be made.
    #[cfg(feature = "meshes")]
    #[error(transparent)]
    Body(#[from] BodyError),
    /// A limit was reached before the answer was.
    #[error("unresolved ({reason}): nothing touches before {safe_until}, later is not known")]
    Unresolved {
        /// Nothing touches before this time.
        safe_until: f64,
        /// Which limit.
        reason: Limit,
    },
}

#[cfg(feature = "meshes")]
impl From<PrepareError> for Error {
    fn from(error: PrepareError) -> Self {
        Error::Body(error.into())
    }
}
