//! The limits of a query's work, the work done, and the scratch memory.

use super::scratch::{Memory, Scratch};
use crate::answer::{Limit, Stats};
use crate::problem::Problem;
use crate::tuning::WORK_BETWEEN_LOOKS;
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Counts the work of a query, and ends the query at its limit.
#[derive(Debug)]
pub(crate) struct Meter {
    pub(crate) stats: Stats,
    pub(crate) scratch: Scratch,
    /// The time of the deadline; `None` if there is none. No clock is read then.
    end: Option<Instant>,
    /// The work at which the clock and the stop flag are read next; never if there are none.
    next_look: u64,
}

impl Meter {
    /// Starts the meter at the present time.
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

    /// Returns the memory for searches that need lists.
    pub(crate) fn memory(&mut self) -> &mut Memory {
        self.scratch.get_or_insert_default()
    }

    /// Counts a pair that is about to be visited.
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
