//! The reasons why pairs of links are not checked.

use std::fmt;

/// The reason why a pair of links is not checked.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SkipReason {
    /// A joint connects the two links directly.
    Adjacent,
    /// No joint moves one link relative to the other.
    NoMotion,
    /// The caller or a file, such as an SRDF, disables the pair. The text is the reason that it states.
    Disabled(String),
}

/// Pairs of links that are not checked for the same reason.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct LeftOutPairs {
    /// The reason.
    pub reason: SkipReason,
    /// The names of both links of each pair.
    pub pairs: Vec<[String; 2]>,
}

impl fmt::Display for SkipReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SkipReason::Adjacent => f.write_str("adjacent"),
            SkipReason::NoMotion => f.write_str("no joint between them moves"),
            SkipReason::Disabled(reason) if reason.is_empty() => f.write_str("disabled"),
            SkipReason::Disabled(reason) => write!(f, "disabled: {reason}"),
        }
    }
}
