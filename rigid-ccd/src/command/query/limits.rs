//! Advice to the user for each limit that ended a query early.

use ccd_core::Limit;

/// All limits of a query, each with the advice for a user whose query reached it.
const LIMITS: [(Limit, &str); 5] = [
    (
        Limit::Budget,
        "the budget was spent; a larger --tolerance, or --ask is-free with a --margin, often decides at once; a larger \
         --budget takes longer",
    ),
    (
        Limit::Deadline,
        "the deadline has passed; a larger --tolerance, or --ask is-free with a --margin, often decides at once; a \
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
        Limit::Undecided,
        "too close at the start to decide whether the bodies overlap; move one of them a little",
    ),
];

/// The number of queries that each limit ended.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LimitCounts([usize; LIMITS.len()]);

impl LimitCounts {
    /// Counts a query that ended at the given limit.
    pub(crate) fn add(&mut self, limit: Limit) {
        let place = LIMITS.iter().position(|(known, _)| *known == limit);
        place.into_iter().for_each(|k| self.0[k] += 1);
    }

    /// Returns the number of queries and the advice for each limit that was reached.
    pub(crate) fn advice(&self) -> impl Iterator<Item = (usize, &'static str)> {
        let counts = self.0.iter().zip(LIMITS);
        counts
            .map(|(&count, (_, advice))| (count, advice))
            .filter(|&(count, _)| count > 0)
    }
}
