//! Every number of this crate that is a choice rather than a consequence.

/// Below this many pieces a hierarchy is agglomerated, above it is split at medians.
///
/// Agglomeration takes time quadratic in the pieces where sizes grow steadily along a strip, and
/// builds chains as deep as the strip is long. Unit: pieces. Larger: better trees (see
/// [`crate::build_hierarchy`]), longer worst case.
pub(crate) const AGGLOMERATED_PIECES: usize = 1024;
