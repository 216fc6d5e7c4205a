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
    #[error("unresolved ({reason}): no contact before time {safe_until}, not known after; {}", advice(*.reason))]
    Unresolved {
        /// The time before which no contact happens, certified, in the motions' unit of time.
        safe_until: f64,
        /// The limit that was reached.
        reason: Limit,
    },
}

/// Says what ended a query, and what to do.
///
/// ```
/// let advice = rigid_ccd::advice(rigid_ccd::Limit::Budget);
/// assert!(advice.starts_with("the budget is spent"));
/// ```
pub fn advice(limit: Limit) -> &'static str {
    match limit {
        Limit::Budget => {
            "the budget is spent: a larger tolerance, or is_free with a margin, often decides at once; a larger budget \
             takes longer"
        }
        Limit::Deadline => {
            "the deadline has passed: a larger tolerance, or is_free with a margin, often decides at once; a later \
             deadline takes longer"
        }
        Limit::Stopped => "the query was stopped",
        Limit::Stalled => "no further step can be certified: a larger tolerance may help",
        Limit::OracleGaveUp => "the distance backend gave up: try another one",
        Limit::Undecided => {
            "the bodies are too close at the start to decide whether they overlap: move one of them a little"
        }
        _ => "a limit was reached",
    }
}

#[cfg(feature = "meshes")]
impl From<PrepareError> for Error {
    fn from(error: PrepareError) -> Self {
        Error::Body(error.into())
    }
}
