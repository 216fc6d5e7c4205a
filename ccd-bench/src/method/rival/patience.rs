//! A limit of a rival's work.

/// The largest work for one query before it is given up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patience {
    /// The number of steps in time.
    pub(super) steps: u64,
    /// The number of pairs of nodes whose distance is measured.
    pub(super) pairs: u64,
}

impl Default for Patience {
    /// About ten seconds, thousands of times the cost of a usual query.
    fn default() -> Self {
        Patience {
            steps: 1_000_000,
            pairs: 100_000_000,
        }
    }
}
