//! Termination of a march, and cycle detection.

use crate::feature::{Certainty, Crossing, Pair, Which};

/// The end of a march.
#[derive(Clone, Copy, Debug)]
pub(crate) enum End {
    /// Nearest features.
    Nearest(Pair, Certainty),
    /// A common point of A's and B's features, with the polytope of the edge.
    Common(Pair, Which, Crossing),
    /// A pair that occurred before.
    Cycle(Pair),
    /// A pair behind all faces, without a proven common point.
    Unclear(Pair),
    /// The pair at the cap of steps.
    Cap(Pair),
}

/// Brent's detection of cycles. Each state is compared with a remembered one, which is replaced after 1, 2, 4, … steps.
/// A cycle is detected within three times the sum of its length and of the steps before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Brent {
    left: Pair,
    steps: u32,
    until: u32,
}

impl Brent {
    pub(crate) fn new(start: Pair) -> Self {
        Brent {
            left: start,
            steps: 0,
            until: 1,
        }
    }

    /// Returns whether the march has returned to the remembered state.
    #[inline]
    pub(crate) fn returned(&mut self, pair: Pair) -> bool {
        if pair == self.left {
            return true;
        }
        self.steps += 1;
        if self.steps == self.until {
            self.left = pair;
            self.until = self.until.saturating_mul(2);
            self.steps = 0;
        }
        false
    }
}

#[cfg(test)]
mod tests;
