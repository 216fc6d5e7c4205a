//! Defines the limit on the work of a rival in one query.

/// The maximum work of a rival in one query.
#[derive(Clone, Copy, Debug)]
pub(super) struct WorkLimit {
    /// The maximum number of steps in time.
    pub(super) max_steps: u64,
    /// The maximum number of pairs of nodes whose distance is measured.
    pub(super) max_pairs: u64,
}

impl Default for WorkLimit {
    /// Returns limits of about ten seconds of work, thousands of times the cost of a usual query.
    fn default() -> Self {
        WorkLimit {
            max_steps: 1_000_000,
            max_pairs: 100_000_000,
        }
    }
}
