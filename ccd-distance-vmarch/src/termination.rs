//! The ends of a march, and the detection of cycles.

use crate::feature::{Certainty, CommonPoint, Pair, WhichPolytope};

/// Why and where a march ended.
#[derive(Clone, Copy, Debug)]
pub(crate) enum MarchEnd {
    /// The march reached the nearest features.
    Nearest(Pair, Certainty),
    /// The march found a common point of an edge of one polytope, which is named, and of a feature of the other one.
    CommonPoint(Pair, WhichPolytope, CommonPoint),
    /// The march returned to this pair.
    Cycle(Pair),
    /// A feature of this pair is behind all faces of the other polytope, but no common point could be proven.
    Unclear(Pair),
    /// The march reached its limit of steps at this pair.
    StepLimit(Pair),
}

/// Brent's algorithm for the detection of cycles. Each state is compared with a remembered one, which is replaced after
/// 1, 2, 4, … steps. A cycle is detected within three times the sum of its length and of the steps before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BrentCycleDetector {
    remembered_pair: Pair,
    steps_since_replacement: u32,
    replacement_interval: u32,
}

impl BrentCycleDetector {
    pub(crate) fn new(start: Pair) -> Self {
        BrentCycleDetector {
            remembered_pair: start,
            steps_since_replacement: 0,
            replacement_interval: 1,
        }
    }

    /// Records the next pair of a march, and returns whether it equals the remembered pair.
    #[inline]
    pub(crate) fn record_and_detect(&mut self, pair: Pair) -> bool {
        if pair == self.remembered_pair {
            return true;
        }
        self.steps_since_replacement += 1;
        if self.steps_since_replacement == self.replacement_interval {
            self.remembered_pair = pair;
            self.replacement_interval = self.replacement_interval.saturating_mul(2);
            self.steps_since_replacement = 0;
        }
        false
    }
}

#[cfg(test)]
mod tests;
