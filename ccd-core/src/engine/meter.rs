//! Counts a query's work, and enforces its limits.

use super::scratch::{Memory, Scratch};
use crate::answer::{Limit, Stats};
use crate::problem::Problem;
use crate::tuning::WORK_BETWEEN_LOOKS;
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Counts the work of a query, and stops the query at its limit.
#[derive(Debug)]
pub(crate) struct Meter {
    pub(crate) stats: Stats,
    pub(crate) scratch: Scratch,
    /// The time at which the deadline passes; `None` without a deadline. No clock is read then.
    end: Option<Instant>,
    /// The amount of work at which the clock and the stop flag are read next; unreachable if there are none.
    next_look: u64,
}

impl Meter {
    /// Starts counting, and starts the deadline's time.
    pub(crate) fn new(problem: &Problem<'_>) -> Self {
        // A deadline that no clock can represent counts as none.
        let end = |deadline| Instant::now().checked_add(deadline);
        let end = problem.deadline.and_then(end);
        Meter {
            stats: Stats::default(),
            scratch: None,
            next_look: if end.is_some() || problem.stop.is_some() {
                0
            } else {
                u64::MAX
            },
            end,
        }
    }

    /// Returns the scratch memory, and creates it if necessary.
    pub(crate) fn memory(&mut self) -> &mut Memory {
        self.scratch.get_or_insert_default()
    }

    /// Counts one visit of a pair, and returns an error if a limit is reached.
    #[inline]
    pub(crate) fn visit(&mut self, problem: &Problem<'_>) -> Result<(), Limit> {
        self.stats.iterations += 1;
        let work = self.stats.work();
        if work > problem.budget {
            return Err(Limit::Budget);
        }
        if work >= self.next_look {
            self.look(problem, work)
        } else {
            Ok(())
        }
    }

    #[cold]
    fn look(&mut self, problem: &Problem<'_>, work: u64) -> Result<(), Limit> {
        self.next_look = work.saturating_add(WORK_BETWEEN_LOOKS);
        // The work of the other thread before the flag was set does not matter to this one.
        if problem
            .stop
            .is_some_and(|stop| stop.load(Ordering::Relaxed))
        {
            return Err(Limit::Stopped);
        }
        if self.end.is_some_and(|end| Instant::now() >= end) {
            Err(Limit::Deadline)
        } else {
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests;
