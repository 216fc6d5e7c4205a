//! Whoever answers queries: this project's methods, published rivals built here, peer libraries.

use crate::motions::Query;

/// Answers one query after another about the same two bodies, with the same tolerance.
pub trait Contender {
    /// When the bodies first touch, as far as it can tell.
    fn answer(&mut self, query: &Query) -> Reply;
}

/// Can be told another tolerance, without being made anew.
pub trait Adjustable: Contender {
    /// From now on queries are answered with this tolerance, a length.
    fn set_tolerance(&mut self, tolerance: f64);
}

/// What a contender says of one query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply {
    /// Its answer.
    pub claim: Claim,
    /// How many steps in time it took to find it: advancements, halvings or samples, as it goes.
    pub steps: u64,
}

/// What a contender says happens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Claim {
    /// The bodies come within its tolerance at that time, and not before.
    Contact {
        /// From 0 to the query's duration.
        time: f64,
    },
    /// They do not over the whole duration.
    Free,
    /// It gave up.
    Unresolved {
        /// Until when it says that they do not.
        safe_until: f64,
    },
}
