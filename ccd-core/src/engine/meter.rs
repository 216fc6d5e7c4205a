//! Counts a query's work, and enforces its limits.

use super::scratch::{Scratch, ScratchMemory};
use crate::answer::{Limit, Stats};
use crate::problem::Problem;
use crate::tuning::WORK_BETWEEN_CLOCK_READS;
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Counts the work of a query, and stops the query at its limit.
#[derive(Debug)]
pub(crate) struct Meter {
    pub(crate) stats: Stats,
    pub(crate) scratch: Scratch,
    /// The time at which the deadline passes; `None` without a deadline. No clock is read then.
    deadline_at: Option<Instant>,
    /// The amount of work at which the clock and the stop flag are read next; `u64::MAX` without a deadline and a flag.
    work_at_next_check: u64,
}

impl Meter {
    /// Creates a meter with all counts at zero, and starts to measure the time until the deadline.
    pub(crate) fn new(problem: &Problem<'_>) -> Self {
        // A deadline that no clock can represent counts as none.
        let deadline_at = |deadline| Instant::now().checked_add(deadline);
        let deadline_at = problem.deadline.and_then(deadline_at);
        Meter {
            stats: Stats::default(),
            scratch: None,
            work_at_next_check: if deadline_at.is_some() || problem.stop_flag.is_some() {
                0
            } else {
                u64::MAX
            },
            deadline_at,
        }
    }

    /// Returns the scratch memory, and creates it if necessary.
    pub(crate) fn scratch_memory(&mut self) -> &mut ScratchMemory {
        self.scratch.get_or_insert_default()
    }

    /// Counts one visit of a pair, and returns an error if a limit is reached.
    #[inline]
    pub(crate) fn count_visit_and_check_limits(
        &mut self,
        problem: &Problem<'_>,
    ) -> Result<(), Limit> {
        self.stats.iterations += 1;
        let work = self.stats.budgeted_work();
        if work > problem.budget {
            return Err(Limit::Budget);
        }
        if work >= self.work_at_next_check {
            self.check_stop_flag_and_deadline(problem, work)
        } else {
            Ok(())
        }
    }

    #[cold]
    fn check_stop_flag_and_deadline(
        &mut self,
        problem: &Problem<'_>,
        work: u64,
    ) -> Result<(), Limit> {
        self.work_at_next_check = work.saturating_add(WORK_BETWEEN_CLOCK_READS);
        // The work of the other thread before the flag was set does not matter to this one.
        if problem
            .stop_flag
            .is_some_and(|stop| stop.load(Ordering::Relaxed))
        {
            return Err(Limit::Stopped);
        }
        if self
            .deadline_at
            .is_some_and(|deadline_at| Instant::now() >= deadline_at)
        {
            Err(Limit::Deadline)
        } else {
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests;
