//! The ends of a march, and the detection of cycles.

use crate::feature::{Certainty, Crossing, Pair, Whose};

/// How a march ends.
#[derive(Clone, Copy, Debug)]
pub(crate) enum End {
    /// At nearest features.
    Nearest(Pair, Certainty),
    /// At a common point: of A's features with B, in the order that is told.
    Common(Pair, Whose, Crossing),
    /// Where it had been before.
    Cycle(Pair),
    /// Behind all faces, without a common point that could be proven.
    Unclear(Pair),
    /// At its cap of steps.
    Cap(Pair),
}

/// Brent's detection of cycles: each state is compared with one that was left behind, which is
/// replaced after 1, 2, 4, … steps. A cycle is noticed within three times its length and what came
/// before it.
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

    /// Whether the march has come back to the state that was left behind.
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
