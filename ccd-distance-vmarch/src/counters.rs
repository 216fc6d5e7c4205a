//! Counters of an oracle's work.

/// The work of an oracle over all calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Calls.
    pub calls: u64,
    /// Pairs of features that were tested.
    pub steps: u64,
    /// Cycles that were detected.
    pub cycles: u64,
    /// Features found behind a face, for which all faces were examined.
    pub local_minima: u64,
    /// Marches restarted from other features.
    pub restarts: u64,
    /// Common points, each proven by exact signs.
    pub penetrations: u64,
}
