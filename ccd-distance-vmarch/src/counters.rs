//! Counts of what an oracle met with.

/// What an oracle met with, over all calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// How often it was asked.
    pub calls: u64,
    /// Pairs of features that were tested.
    pub steps: u64,
    /// Pairs that came up again.
    pub cycles: u64,
    /// Features found behind a face, with all faces looked at for it.
    pub local_minima: u64,
    /// Marches taken up again from other features.
    pub restarts: u64,
    /// Common points, each proven by exact signs.
    pub penetrations: u64,
}
