//! The work limit of a rival.

/// The work limit of one query.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patience {
    /// The number of steps in time.
    pub(super) steps: u64,
    /// The number of pairs of nodes whose distance is measured.
    pub(super) pairs: u64,
}

impl Default for Patience {
    /// Returns about ten seconds of work, thousands of times the cost of a usual query.
    fn default() -> Self {
        Patience {
            steps: 1_000_000,
            pairs: 100_000_000,
        }
    }
}
