//! The limits of a search: its work, its deadline and its stop flag.

use crate::path::interval::PathInterval;
use crate::tuning::BUDGETS_PER_SEGMENT;
use rigid_ccd::Settings;
use rigid_ccd::answer::Limit;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// The remaining work of a search, its deadline, and the flag with which another thread stops it.
#[derive(Clone, Debug)]
pub(crate) struct StopCondition {
    /// The budget of a query of two bodies.
    budget: u64,
    /// The limit of `work` for the current search.
    max_work: u64,
    /// The work of the current search so far.
    work: u64,
    /// For a question of many searches, the work that is left for the current search and all later searches.
    work_left_for_question: u64,
    end: Option<Instant>,
    stop: Option<Arc<AtomicBool>>,
}

impl StopCondition {
    pub(crate) const NONE: StopCondition = StopCondition {
        budget: u64::MAX,
        max_work: u64::MAX,
        work: 0,
        work_left_for_question: u64::MAX,
        end: None,
        stop: None,
    };

    /// Creates the limits of a path's searches. The time of the deadline starts now.
    pub(crate) fn starting_now(settings: &Settings) -> Self {
        StopCondition {
            budget: settings.budget,
            max_work: settings.budget,
            work: 0,
            work_left_for_question: u64::MAX,
            // A deadline beyond the range of the clock is no deadline.
            end: settings
                .deadline
                .and_then(|deadline| Instant::now().checked_add(deadline)),
            stop: settings.stop.clone(),
        }
    }

    /// Sets the work limit of a question that searches an interval many times: some budgets for each segment.
    pub(crate) fn begin_searches(&mut self, interval: &PathInterval) {
        self.work_left_for_question = self.max_work_in(interval);
        self.work = 0;
    }

    /// Sets the work limit of one search of an interval: some budgets for each segment, or the remaining work of the
    /// question if it is less.
    pub(crate) fn begin_search(&mut self, interval: &PathInterval) {
        self.work_left_for_question = self.work_left_for_question.saturating_sub(self.work);
        self.max_work = self.max_work_in(interval).min(self.work_left_for_question);
        self.work = 0;
    }

    fn max_work_in(&self, interval: &PathInterval) -> u64 {
        let segments = (interval.to - interval.from).ceil() as u64;
        let budgets = segments.max(1).saturating_mul(BUDGETS_PER_SEGMENT);
        self.budget.saturating_mul(budgets)
    }

    /// Returns whether no further search may begin, because the work is used up, the deadline has passed or the flag
    /// is set.
    pub(crate) fn is_question_over(&self) -> bool {
        self.work >= self.work_left_for_question || self.interruption().is_some()
    }

    /// Adds work, in units of the budget.
    pub(crate) fn add_work(&mut self, work: u64) {
        self.work = self.work.saturating_add(work);
    }

    /// Returns the budget of the next query: the budget of the settings, or the remaining work if it is less.
    pub(crate) fn budget_of_query(&self) -> u64 {
        self.budget.min(self.work_left())
    }

    fn work_left(&self) -> u64 {
        self.max_work.saturating_sub(self.work)
    }

    /// Returns the work of the current search, in units of the budget.
    #[cfg(test)]
    pub(crate) fn work(&self) -> u64 {
        self.work
    }

    /// Returns the limit that ends the current search; `None` if it may continue.
    pub(crate) fn reached_limit(&self) -> Option<Limit> {
        let is_spent = self.work_left() == 0;
        self.interruption()
            .or_else(|| is_spent.then_some(Limit::Budget))
    }

    /// Returns the deadline or stop that ends all searches of the path; `None` if they may continue.
    pub(crate) fn interruption(&self) -> Option<Limit> {
        if self.end.is_some_and(|end| Instant::now() >= end) {
            return Some(Limit::Deadline);
        }
        let stop = self.stop.as_ref();
        let is_stopped = stop.is_some_and(|stop| stop.load(Ordering::Relaxed));
        is_stopped.then_some(Limit::Stopped)
    }

    /// Returns the time until the deadline.
    pub(crate) fn remaining(&self) -> Option<Duration> {
        self.end
            .map(|end| end.saturating_duration_since(Instant::now()))
    }
}
