//! All numeric tolerances of this crate, each with its unit, derivation, and purpose.
//!
//! `u` is half a unit in the last place of 1. Lengths are in the unit of the pieces' coordinates. A pair's *size* is
//! the sum of both pieces' radii about their own origins, and of the distance of those origins.

/// The largest relative rounding error of one operation in f64.
const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// The largest rounding error of a difference of two transformed points, in units of the pair's size.
///
/// A vertex is rounded once when it is taken relative to its polytope's origin (1u), placed by
/// three products and three sums whose matrix is rounded (8u of its reach, per coordinate, √3 of
/// that as a length), and subtracted (1u): below 16u. Points nearer than that are the same point.
/// Without it the march would follow directions that are nothing but rounding.
pub(crate) const PLACEMENT_ERROR_BOUND: f64 = 16.0 * UNIT_ROUNDOFF;

/// The largest rounding error of the scalar product of two unit vectors, one of them transformed. Each is rounded when
/// it is made (1u), one is turned (3u), and the product adds 3u. Without it a march would wander between the corners of
/// a face that is parallel to the other one. A larger value would stop at corners next to nearer ones, by that much of
/// an edge's length.
pub(crate) const DOT_PRODUCT_ERROR_BOUND: f64 = 8.0 * UNIT_ROUNDOFF;

/// The sine below which two edges count as parallel. Their cross product is then rounding, and all points of their
/// overlap are equally near, to `MAX_PARALLEL_SINE` times the edges' length.
pub(crate) const MAX_PARALLEL_SINE: f64 = 16.0 * UNIT_ROUNDOFF;

/// The distance, in units of the pair's size, above which a tie between features needs no certificate. Rounding, 16u of
/// the size, tilts a direction of that length at a cost of at most 64u of the size.
pub(crate) const MIN_CERTAIN_DISTANCE_RATIO: f64 = 1.0 / 4.0;

/// The largest difference between the distance and the support gap at which the distance counts as certified, in units
/// of the pair's size. It equals [`PLACEMENT_ERROR_BOUND`], the error of that distance. A larger value would accept a tie with
/// a nearer pair around it; a smaller one would search around in vain.
pub(crate) const MAX_CERTIFIED_GAP_DEFICIT: f64 = 16.0 * UNIT_ROUNDOFF;

/// The part of the allowed gap deficit that grows with the distance: a certificate's support gap may fall short of the
/// distance by [`MAX_CERTIFIED_GAP_DEFICIT`] · size + this · distance. It is for pieces that are much farther apart
/// than they are large.
pub(crate) const MAX_RELATIVE_CERTIFIED_GAP_DEFICIT: f64 = 32.0 * UNIT_ROUNDOFF;

/// The distance from a plane or a line up to which points count as on it, in units of the largest coordinate. Corners
/// have input rounding of 1u each, a plane through three of them passes the others by up to 4u, and heights over it are
/// rounded by up to 8u. Without it a triangulated square would have a diagonal, with Voronoi slabs of no width on both
/// sides.
pub(crate) const COPLANARITY_TOLERANCE: f64 = 16.0 * UNIT_ROUNDOFF;

/// The height above a facet's plane up to which a corner counts as behind the facet. Its unit is the largest coordinate
/// times the ratio of the piece's length to the facet's width. If corners were rounded after the hull was made, a
/// facet's normal turns by their rounding over its width. Without it no sliver would be accepted; a larger value would
/// accept facets that enclose nothing.
pub(crate) const CONVEXITY_TOLERANCE: f64 = 64.0 * UNIT_ROUNDOFF;

/// The largest number of steps of a march, per feature of both polytopes. In exact arithmetic a march visits every pair
/// at most once, and one per feature in practice; Lloyd's port of V-Clip stops at two.
pub(crate) const MAX_STEPS_PER_FEATURE: usize = 4;

/// The largest number of pairs of a cycle that are examined for the nearest pair. Cycles are two to six pairs long.
pub(crate) const MAX_CYCLE_PAIRS: usize = 64;

/// The largest number of times that a pair of features as near as its neighbours is replaced by a nearer one, before
/// the march resumes. Each move gets nearer by more than rounding; one or two were enough in a million pairs. It also
/// limits the marches of one call.
pub(crate) const MAX_TIE_MOVES: usize = 8;

/// The largest number of restarts of a march after a cycle or a similar end, before the oracle gives up. A restart
/// begins at the corners that are extremal along the best axis.
pub(crate) const MAX_RESTARTS: u32 = 2;

/// The largest number of edges of each polytope from which axes are computed if the nearest points coincide up to
/// rounding. They are the edges closest to a right angle to the vector between these points. Five to ten edges meet in
/// a common corner.
pub(crate) const MAX_AXIS_EDGES: usize = 12;

/// The number of pairs of an edge and a face above which no common point is searched for. Testing so many takes a few
/// milliseconds.
pub(crate) const MAX_EDGE_FACE_PAIRS: usize = 1 << 17;

/// The number of pairs of edges around a tie above which no nearer pair is searched for. Two corners of 30 edges have
/// about so many.
pub(crate) const MAX_TIE_EDGE_PAIRS: usize = 1 << 13;

/// The number of corners up to which a polytope is scanned for an extremal one; with more, it has a table of
/// directions. Scanning takes one or two nanoseconds per vertex, a climb from the table about thirty.
pub(crate) const MAX_SCANNED_CORNERS: usize = 32;
