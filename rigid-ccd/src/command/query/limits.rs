//! What ends a query early, in words.

use ccd_core::Limit;

/// A limit, and what to do about it.
const LIMITS: [(Limit, &str); 5] = [
    (Limit::Budget, "the budget was spent; --budget raises it"),
    (
        Limit::Deadline,
        "the deadline was passed; --deadline gives more time",
    ),
    (
        Limit::Stalled,
        "no step forward could be certified; a larger --tolerance may help",
    ),
    (
        Limit::OracleGaveUp,
        "the oracle gave up; another --oracle may not",
    ),
    (
        Limit::Undecided,
        "at the start it cannot be told whether the bodies overlap; move one of them a little",
    ),
];

/// How often each limit ended a query.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Reached([usize; LIMITS.len()]);

impl Reached {
    /// One more query ended by it.
    pub(crate) fn add(&mut self, limit: Limit) {
        let place = LIMITS.iter().position(|(known, _)| *known == limit);
        place.into_iter().for_each(|k| self.0[k] += 1);
    }

    /// Those that were reached: how often, and what to do about it.
    pub(crate) fn advice(&self) -> impl Iterator<Item = (usize, &'static str)> {
        let counts = self.0.iter().zip(LIMITS);
        counts
            .map(|(&count, (_, advice))| (count, advice))
            .filter(|&(count, _)| count > 0)
    }
}
