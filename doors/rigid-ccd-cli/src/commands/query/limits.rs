//! Advice to the user for each limit that ended a query early.

use ccd_core::Limit;

/// The limits that may end a query, each with advice for a user whose query reached the limit.
pub(super) const LIMIT_ADVICE: [(Limit, &str); 5] = [
    (
        Limit::Budget,
        "the budget was spent; a larger --tolerance, or --question is-free with a --margin, often decides at once; a larger \
         --budget takes longer",
    ),
    (
        Limit::Deadline,
        "the deadline has passed; a larger --tolerance, or --question is-free with a --margin, often decides at once; a \
         later --deadline takes longer",
    ),
    (
        Limit::Stalled,
        "no further step could be certified; a larger --tolerance may help",
    ),
    (
        Limit::OracleGaveUp,
        "the distance backend gave up; try another --oracle",
    ),
    (
        Limit::OverlapUndecided,
        "too close at the start to decide whether the bodies overlap; move one of them a little",
    ),
];
