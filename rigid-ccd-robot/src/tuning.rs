//! Numbers that only cost time: answers are right with any values.

/// The number of times that an edge is halved before pairs go to the engine. Each halving costs the frames of all links
/// and a distance for each open pair; the engine costs about ten of these.
pub(crate) const MAX_HALVINGS: u32 = 4;

/// The displacement in half a stretch, in metres, beyond which the distance in the middle of the stretch hardly ever
/// proves it free. Pairs are then measured only if their boxes meet there.
pub(crate) const FAR_DISPLACEMENT: f64 = 0.1;

/// The largest number of convex hulls around parts of an obstacle that is not convex, and around parts of a link. The
/// hulls of an obstacle are found by their boxes; those of links are all compared.
pub(crate) const MAX_OBSTACLE_PARTS: usize = 16;
pub(crate) const MAX_LINK_PARTS: usize = 1;

/// The least number of pieces that are split into two hulls.
pub(crate) const MIN_PIECES_TO_SPLIT: usize = 16;
