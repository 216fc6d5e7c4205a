//! Counters of an oracle's work.

/// Counts of what an oracle has done, summed over all calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// The number of calls of the oracle.
    pub calls: u64,
    /// The number of tested pairs of features.
    pub steps: u64,
    /// The number of detected cycles.
    pub detected_cycles: u64,
    /// The number of local minima: a feature was found behind a face, and all faces were examined.
    pub local_minima: u64,
    /// The number of marches that were restarted from other features.
    pub restarts: u64,
    /// The number of common points that were found, each proven by exact signs.
    pub penetrations: u64,
}
