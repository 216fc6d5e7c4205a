//! The cost of an answer.

use crate::distance::oracle::Effort;
use crate::tuning::LOOKS_PER_VISIT;

/// The cost of an answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// The number of pairs of nodes that were bounded or split, pairs of pieces included.
    pub iterations: u64,
    /// The approximate number of evaluations of points of pieces: in each step of an oracle's search, and each time a
    /// gap is followed.
    pub point_looks: u64,
    /// The number of calls of the oracle.
    pub oracle_calls: u64,
    /// The number of times that the oracle gave up.
    pub give_ups: u64,
    /// The largest number of pairs that waited at one time.
    pub peak_front: u64,
    /// The number of times that all pairs were advanced together: the steps of conservative
    /// advancement, the first distance included. 0 for schedules with a clock for every pair.
    pub advancements: u64,
    /// The effort of the oracle.
    pub effort: Effort,
}

impl Stats {
    /// Returns the work that the [budget](crate::Settings::budget) limits: iterations, plus one for every
    /// [`LOOKS_PER_VISIT`] evaluations of points.
    #[inline]
    pub fn work(&self) -> u64 {
        self.iterations + self.point_looks / LOOKS_PER_VISIT
    }

    /// Adds the cost of another answer.
    pub(crate) fn add(&mut self, other: &Stats) {
        self.iterations += other.iterations;
        self.point_looks += other.point_looks;
        self.oracle_calls += other.oracle_calls;
        self.give_ups += other.give_ups;
        self.peak_front = self.peak_front.max(other.peak_front);
        self.advancements += other.advancements;
        self.effort = self.effort + other.effort;
    }
}
