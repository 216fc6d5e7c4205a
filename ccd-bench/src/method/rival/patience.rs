//! How long a rival goes on.

/// What a query may cost before it is given up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patience {
    /// Steps in time.
    pub(super) steps: u64,
    /// Pairs of nodes whose distance is measured.
    pub(super) pairs: u64,
}

impl Default for Patience {
    /// Some ten seconds, thousands of times what a query takes.
    fn default() -> Self {
        Patience {
            steps: 1_000_000,
            pairs: 100_000_000,
        }
    }
}
