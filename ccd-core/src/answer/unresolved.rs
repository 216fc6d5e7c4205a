//! The bounds that are proven when a limit ends a query.

use super::Contact;
use std::fmt;

/// The bounds that were proven before a limit ended a query.
///
/// The type is also an error, for callers that need an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unresolved {
    /// The limit that ended the query.
    pub limit: Limit,
    /// A certified time before which the bodies do not touch; 0 for queries about a distance.
    pub safe_until: f64,
    /// A certified time after which the bodies do not touch; infinite unless the query is about the last contact.
    pub safe_from: f64,
    /// A lower bound of the requested distance; 0 if none is proven.
    pub lower: f64,
    /// An upper bound of the requested distance; infinite if none is known.
    pub upper: f64,
    /// The time of the smallest measured distance, and the nearest pieces at that time. `None` if no distance was
    /// measured.
    pub nearest_contact: Option<(f64, Contact)>,
}

impl Unresolved {
    /// Creates the bounds of a query about contacts: the bodies do not touch before `safe_until`.
    pub fn from_safe_until(safe_until: f64, limit: Limit) -> Self {
        Unresolved {
            limit,
            safe_until,
            safe_from: f64::INFINITY,
            lower: 0.0,
            upper: f64::INFINITY,
            nearest_contact: None,
        }
    }

    /// Creates the bounds of a query about the least distance: a lower bound, and the nearest pieces that were
    /// measured.
    pub(crate) fn for_least_distance(lower: f64, at: Option<(f64, Contact)>, limit: Limit) -> Self {
        Unresolved {
            lower,
            nearest_contact: at,
            ..Unresolved::from_safe_until(0.0, limit)
        }
        .with_measured_upper_bound()
    }

    /// Sets the upper bound to that of the measured contact; infinite if no distance was measured.
    pub(super) fn with_measured_upper_bound(self) -> Self {
        let upper = |(_, contact): (f64, Contact)| contact.separation.upper;
        Unresolved {
            upper: self.nearest_contact.map_or(f64::INFINITY, upper),
            ..self
        }
    }
}

impl fmt::Display for Unresolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Unresolved {
            limit, safe_until, ..
        } = self;
        write!(
            f,
            "unresolved ({limit}): no contact before time {safe_until}, not known after; {}",
            limit.advice()
        )
    }
}

impl std::error::Error for Unresolved {}

/// The reason why a query ended before its answer was known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limit {
    /// The [budget](crate::Settings::budget) was spent.
    Budget,
    /// The [deadline](crate::Settings::deadline) was passed.
    Deadline,
    /// The caller [stopped](crate::Settings::stop) the query.
    Stopped,
    /// The time until which a pair is proven apart cannot advance: the next step is smaller than the resolution of
    /// time.
    Stalled,
    /// The oracle gave up on a pair, and no other oracle was available.
    OracleGaveUp,
    /// Rounding leaves it undecided whether the bodies overlap at the start. They touch then, or one may be inside the
    /// other.
    OverlapUndecided,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Limit::Budget => "budget",
            Limit::Deadline => "deadline",
            Limit::Stopped => "stopped",
            Limit::Stalled => "stalled",
            Limit::OracleGaveUp => "oracle gave up",
            Limit::OverlapUndecided => "undecided",
        })
    }
}

impl Limit {
    /// All limits.
    pub const ALL: [Limit; 6] = [
        Limit::Budget,
        Limit::Deadline,
        Limit::Stopped,
        Limit::Stalled,
        Limit::OracleGaveUp,
        Limit::OverlapUndecided,
    ];

    /// Returns a text that says why a query ended and what the caller can do about it.
    ///
    /// ```
    /// assert!(ccd_core::Limit::Budget.advice().starts_with("the budget is spent"));
    /// ```
    pub fn advice(self) -> &'static str {
        match self {
            Limit::Budget => {
                "the budget is spent: a larger tolerance, or is_free with a margin, often decides at once; a larger \
                 budget takes longer"
            }
            Limit::Deadline => {
                "the deadline has passed: a larger tolerance, or is_free with a margin, often decides at once; a \
                 later deadline takes longer"
            }
            Limit::Stopped => "the query was stopped",
            Limit::Stalled => "no further step can be certified: a larger tolerance may help",
            Limit::OracleGaveUp => "the distance backend gave up: try another one",
            Limit::OverlapUndecided => {
                "the bodies are too close at the start to decide whether they overlap: move one of them a little"
            }
        }
    }
}
