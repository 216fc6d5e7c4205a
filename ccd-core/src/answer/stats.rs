//! Counters for the work of a query.

use crate::distance::oracle::Effort;
use crate::tuning::EVALUATIONS_PER_VISIT;

/// Counters for the work that a query took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// The number of pairs of nodes that were bounded or split, pairs of pieces included.
    pub iterations: u64,
    /// The approximate number of evaluations of piece points, in the oracle's searches and in bounds of future gaps.
    pub point_evaluations: u64,
    /// The number of calls of the oracle.
    pub oracle_calls: u64,
    /// The number of oracle calls that returned no result.
    pub give_ups: u64,
    /// The largest number of pairs that waited in the queue at one time.
    pub peak_front: u64,
    /// The number of steps in which all pairs advanced together, the first distance included. These are the steps of
    /// conservative advancement. It is 0 for schedules with a clock for every pair.
    pub advancements: u64,
    /// The work of the oracle, in its own steps.
    pub effort: Effort,
}

impl Stats {
    /// Returns the work that the [budget](crate::Settings::budget) limits: iterations, plus one for every
    /// [`EVALUATIONS_PER_VISIT`] evaluations of points.
    #[inline]
    pub fn work(&self) -> u64 {
        self.iterations + self.point_evaluations / EVALUATIONS_PER_VISIT
    }

    /// Adds the counters of another answer.
    pub(crate) fn add(&mut self, other: &Stats) {
        self.iterations += other.iterations;
        self.point_evaluations += other.point_evaluations;
        self.oracle_calls += other.oracle_calls;
        self.give_ups += other.give_ups;
        self.peak_front = self.peak_front.max(other.peak_front);
        self.advancements += other.advancements;
        self.effort = self.effort + other.effort;
    }
}
