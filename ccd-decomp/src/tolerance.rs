//! Every number of this crate that is a choice rather than a consequence: its unit, and what it buys.

/// Below this many pieces a hierarchy is agglomerated, above it is split at medians.
///
/// Unit: pieces. Larger: better trees by a few percent, but pieces with one common centre take time
/// that grows with it.
pub(crate) const AGGLOMERATED_PIECES: usize = 256;

/// After so many passes of agglomeration a node looks for its neighbour farther than one place away.
///
/// Unit: passes. Fewer: slower, hardly better trees.
pub(crate) const SEARCH_DEPTH: usize = 2;

/// The share of the nodes, the largest first, that are tried at a better place in the tree.
///
/// Unit: one. Larger: better trees by a percent for every doubling, but slower to build.
pub(crate) const REINSERTED_SHARE: f32 = 0.02;
