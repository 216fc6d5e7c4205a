//! Whoever answers queries: this project's methods, published rivals built here, peer libraries.

use rigid_ccd::batch::median;
use rigid_ccd::table::motions::Query;
use std::time::{Duration, Instant};

/// Answers one query after another about the same two bodies, with the same tolerance.
pub trait Solver {
    /// When the bodies first touch, as far as it can tell.
    fn answer(&mut self, query: &Query) -> Reply;
}

/// A reply, and how long it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedReply {
    /// The reply.
    pub reply: Reply,
    /// In microseconds.
    pub micros: f64,
}

/// A query is answered up to so often, and its time is the median of all answers but the first, which
/// finds caches cold, since clocks and caches make short times unsure,
const REPEATS: usize = 4;
/// unless that has taken so long already.
const REPEATED_WITHIN: Duration = Duration::from_millis(40);

/// Asks a query, and times it: alike for all solvers.
pub fn timed(solver: &mut dyn Solver, query: &Query) -> TimedReply {
    let mut micros = Vec::with_capacity(REPEATS);
    let first = Instant::now();
    loop {
        let start = Instant::now();
        let reply = solver.answer(query);
        micros.push(start.elapsed().as_secs_f64() * 1e6);
        if first.elapsed() > REPEATED_WITHIN || micros.len() == REPEATS {
            let warm = usize::from(micros.len() > 1);
            let micros = median(&mut micros[warm..]);
            return TimedReply { reply, micros };
        }
    }
}

/// Can be told another tolerance, without being made anew.
pub trait Adjustable: Solver {
    /// From now on queries are answered with this tolerance, a length.
    fn set_tolerance(&mut self, tolerance: f64);
}

/// What a solver says of one query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply {
    /// Its answer.
    pub claim: Claim,
    /// How many steps in time it took to find it: advancements, halvings or samples, as it goes.
    pub steps: u64,
}

/// What a solver says happens.
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
    /// It has no way to be asked this.
    Refused,
}
