//! The work that a query may do, and the work that it did.

use crate::outcome::{Limit, Stats};
use crate::problem::Problem;
use crate::tolerance::WORK_BETWEEN_LOOKS;
use std::time::Instant;

/// Counts what a query takes, and ends it when that is as much as it may.
#[derive(Debug)]
pub(crate) struct Meter {
    pub(crate) stats: Stats,
    budget: u64,
    /// None where there is no end, and no clock is read.
    end: Option<Instant>,
    /// The work at which the clock is read next.
    next_look: u64,
}

impl Meter {
    /// Begins now.
    pub(crate) fn new(problem: &Problem<'_>) -> Self {
        // An end that no clock will ever show is none.
        let end = |deadline| Instant::now().checked_add(deadline);
        Meter {
            stats: Stats::default(),
            budget: problem.budget,
            end: problem.deadline.and_then(end),
            next_look: 0,
        }
    }

    /// One more pair is about to be visited.
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
