//! Proves increasing lower bounds of the least distance, for a search that may reach a limit before its answer.
//!
//! A search for the least distance proves it pair by pair, and has no bound for the whole bodies until its end. Half
//! of the distance is proven much sooner. A long search therefore stops now and then, and attempts to prove a share of
//! the least distance measured so far.

use crate::math::order::greater;
use crate::problem::Problem;

/// A sequence of attempts, each of which tries to prove a share of the least measured distance as a lower bound. The
/// share increases after each success, and decreases after each failure.
#[derive(Debug)]
pub(crate) struct LowerBoundAttempts {
    /// The amount of work of the search after which it next tries to prove a lower bound.
    work_before_next_attempt: u64,
    /// The amount of work of the search after which it tries to prove a lower bound for the last time. The rest of the
    /// budget is reserved for this attempt.
    work_before_final_attempt: u64,
    /// The share of the least measured distance that the next attempt tries to prove.
    next_distance_share: f64,
    /// The greatest lower bound proven so far of the distance at all times.
    pub(crate) lower: f64,
}

/// One attempt to prove a lower bound: a query for any contact within a margin. If there is no contact, the margin is a
/// lower bound.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MarginQuery {
    pub(crate) margin: f64,
    pub(crate) tolerance: f64,
    /// The largest amount of work for the attempt.
    pub(crate) budget: u64,
}

impl MarginQuery {
    /// Returns the problem with the margin, tolerance and budget of this attempt.
    pub(crate) fn problem<'a>(&self, problem: &Problem<'a>) -> Problem<'a> {
        let mut asking = problem.with_margin_and_tolerance(self.margin, self.tolerance);
        asking.budget = self.budget;
        asking
    }
}

/// The amount of work after which a search first tries to prove a lower bound. Most searches end sooner.
const WORK_BEFORE_FIRST_ATTEMPT: u64 = 1 << 17;

/// The amount of work after which a search with a deadline or a stop flag first tries to prove a lower bound.
const WORK_BEFORE_FIRST_TIMED_ATTEMPT: u64 = 1 << 14;

/// The largest number of attempts to prove a lower bound at the end of a search that could not prove all pairs.
pub(crate) const MAX_FINAL_ATTEMPTS: usize = 8;

impl LowerBoundAttempts {
    /// Creates the sequence with a known lower bound, for a search with a given budget.
    pub(crate) fn new(lower: f64, budget: u64) -> Self {
        let last = budget - budget / 4;
        LowerBoundAttempts {
            work_before_next_attempt: WORK_BEFORE_FIRST_ATTEMPT.min(last),
            work_before_final_attempt: last,
            next_distance_share: 0.5,
            // Written so that NaN is no bound.
            lower: if lower > 0.0 { lower } else { 0.0 },
        }
    }

    /// Makes the first attempt earlier if a deadline or another thread may end the search.
    pub(crate) fn with_earlier_first_attempt_if_timed(mut self, is_timed: bool) -> Self {
        if is_timed {
            self.work_before_next_attempt = self
                .work_before_next_attempt
                .min(WORK_BEFORE_FIRST_TIMED_ATTEMPT);
        }
        self
    }

    /// Returns the next attempt if the search has done enough work since the last attempt. It may take half as much
    /// work as was done before.
    #[inline]
    pub(crate) fn next_attempt_if_due(&mut self, work: u64, upper: f64) -> Option<MarginQuery> {
        if work < self.work_before_next_attempt {
            return None;
        }
        self.work_before_next_attempt = if work < self.work_before_final_attempt {
            work.saturating_mul(8).min(self.work_before_final_attempt)
        } else {
            u64::MAX
        };
        self.next_attempt(upper, work / 2)
    }

    /// Returns the next attempt for a least measured distance of `upper`; `None` if no distance is measured, no budget
    /// is left, or success would not increase the lower bound.
    pub(crate) fn next_attempt(&self, upper: f64, budget: u64) -> Option<MarginQuery> {
        let level = self.next_distance_share * upper;
        // The tolerance leaves room for proofs.
        let (margin, tolerance) = (0.75 * level, 0.25 * level);
        (margin > self.lower && level < f64::INFINITY && budget > 0).then_some(MarginQuery {
            margin,
            tolerance,
            budget,
        })
    }

    /// Records the lower bound that an attempt proved, or `None` if it proved none, and chooses which share of the upper
    /// bound the next attempt tries to prove.
    pub(crate) fn record_attempt(&mut self, proven: Option<f64>) {
        match proven {
            Some(proven) => {
                self.lower = greater(self.lower, proven);
                self.next_distance_share = 0.5 + 0.5 * self.next_distance_share;
            }
            None => self.next_distance_share *= 0.25,
        }
    }
}
