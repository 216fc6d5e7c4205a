//! The work of an oracle.

/// Counters for the work of an oracle, over many calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// The number of steps from one feature or simplex to the next.
    pub steps: u64,
    /// The number of times that a search returned to an earlier state.
    pub cycle_count: u64,
    /// The number of times that the oracle gave up and another one was called.
    pub fallbacks: u64,
}

impl std::ops::Add for Effort {
    type Output = Effort;

    fn add(self, other: Effort) -> Effort {
        Effort {
            steps: self.steps + other.steps,
            cycle_count: self.cycle_count + other.cycle_count,
            fallbacks: self.fallbacks + other.fallbacks,
        }
    }
}

impl std::ops::Sub for Effort {
    type Output = Effort;

    /// Returns the counts since an earlier state of the counters.
    fn sub(self, earlier: Effort) -> Effort {
        Effort {
            steps: self.steps - earlier.steps,
            cycle_count: self.cycle_count - earlier.cycle_count,
            fallbacks: self.fallbacks - earlier.fallbacks,
        }
    }
}
