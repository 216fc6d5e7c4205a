//! What ends a query early, in words.

use ccd_core::Limit;

/// A limit, its word in the tables, and what to do about it.
const LIMITS: [(Limit, &str, &str); 5] = [
    (
        Limit::Budget,
        "budget",
        "the budget was spent; --budget raises it",
    ),
    (
        Limit::Deadline,
        "deadline",
        "the deadline was passed; --deadline gives more time",
    ),
    (
        Limit::Stalled,
        "stalled",
        "no step forward could be certified; a larger --tolerance may help",
    ),
    (
        Limit::OracleGaveUp,
        "oracle gave up",
        "the oracle gave up; another --oracle may not",
    ),
    (
        Limit::Undecided,
        "undecided",
        "at the start it cannot be told whether the bodies overlap; move one of them a little",
    ),
];

/// What the tables call it.
pub(crate) fn word(limit: Limit) -> &'static str {
    let known = LIMITS.iter().find(|(known, ..)| *known == limit);
    known.map_or("limit", |&(_, word, _)| word)
}

/// How often each limit ended a query.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Reached([usize; LIMITS.len()]);

impl Reached {
    /// One more query ended by it.
    pub(crate) fn add(&mut self, limit: Limit) {
        let place = LIMITS.iter().position(|(known, ..)| *known == limit);
        place.into_iter().for_each(|k| self.0[k] += 1);
    }

    /// Those that were reached: how often, and what to do about it.
    pub(crate) fn advice(&self) -> impl Iterator<Item = (usize, &'static str)> {
        let counts = self.0.iter().zip(LIMITS);
        counts
            .map(|(&count, (.., advice))| (count, advice))
            .filter(|&(count, _)| count > 0)
    }
}
