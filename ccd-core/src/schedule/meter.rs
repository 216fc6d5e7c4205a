//! The limits of a query's work, and the work done.

use crate::outcome::{Limit, Stats};
use crate::problem::Problem;
use crate::tolerance::WORK_BETWEEN_LOOKS;
use std::time::Instant;

/// Counts the work of a query, and ends the query at its limit.
#[derive(Debug)]
pub(crate) struct Meter {
    pub(crate) stats: Stats,
    budget: u64,
    /// None if there is no deadline; then no clock is read.
    end: Option<Instant>,
    /// The work at which the clock is read next.
    next_look: u64,
}

impl Meter {
    /// Starts the meter now.
    pub(crate) fn new(problem: &Problem<'_>) -> Self {
        // A deadline that no clock can represent counts as none.
        let end = |deadline| Instant::now().checked_add(deadline);
        Meter {
            stats: Stats::default(),
            budget: problem.budget,
            end: problem.deadline.and_then(end),
            next_look: 0,
        }
    }

    /// Counts a pair that is about to be visited.
    #[inline]
    pub(crate) fn visit(&mut self) -> Result<(), Limit> {
        self.stats.iterations += 1;
        let work = self.stats.work();
        if work > self.budget {
            return Err(Limit::Budget);
        }
        match self.end {
            Some(end) if work >= self.next_look => {
                self.next_look = work.saturating_add(WORK_BETWEEN_LOOKS);
                match Instant::now() < end {
                    true => Ok(()),
                    false => Err(Limit::Deadline),
                }
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
