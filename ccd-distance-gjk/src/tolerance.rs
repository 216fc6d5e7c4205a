//! All numeric tolerances of this crate, each with its unit, derivation, and purpose.

/// A search ends only if the support gap along its axis is at least this fraction of the distance of the nearest points
/// found.
///
/// Witnesses of pieces of size s carry rounding of about u·s. Their difference, of length d, is
/// therefore tilted by u·s/d, and loses u·s²/d of the support gap: a share u·(s/d)² of d. Above d =
/// 1e-7 s that is less than 1/64 and the difference is a good axis. Below, the axis is computed
/// from the features instead. A larger share would replace good axes; without it, pieces closer
/// than 1e-8 s appear to intersect.
pub(crate) const MIN_CERTIFIED_SHARE: f64 = 63.0 / 64.0;

/// Pieces are tested for intersection if the gap along the best axis is less than this fraction of the nearest points'
/// distance. The nearest features' own axes keep [`MIN_CERTIFIED_SHARE`]; a half is far from it and from 0.
pub(crate) const INTERSECTION_TEST_GAP_RATIO: f64 = 0.5;

/// The largest number of steps of a GJK search.
///
/// Hulls take 3 to 10 steps, finely tessellated spheres up to about 30; beyond, steps only change rounding. The claim
/// at the cap is valid, but less tight.
pub(crate) const MAX_STEPS: u32 = 64;

/// The largest number of times that a GJK search continues from the axes of features, if its own axis is too poor.
pub(crate) const MAX_FEATURE_AXIS_ROUNDS: u32 = 4;

/// The difference of support gap and distance at which GJK has converged, in units in the last place of the distance.
pub(crate) const CONVERGED_ULPS: f64 = 16.0;

/// The difference of support gap and distance above which a stalled GJK search continues, in units in the last place of
/// the distance (1e-12 of it). A smaller value would spend steps on irrelevant digits.
pub(crate) const CERTIFIED_ULPS: f64 = 4096.0;

/// The distance below which pieces count as touching, in units in the last place of the coordinates' difference. A
/// vertex b − a and a combination of four are rounded by about 2 units each.
pub(crate) const TOUCHING_ULPS: f64 = 4.0;

/// The rounding of a signed volume of a tetrahedron, in units in the last place of the product of
/// its three edges' lengths: 3 for the cross product, 3 for the scalar product, 2 for the edges. A
/// volume below it has no sign. Without it, a flat tetrahedron next to the origin may pass for one
/// around it.
pub(crate) const VOLUME_ULPS: f64 = 8.0;

/// The largest number of vertices of the difference that are combined when an axis is computed from features. Three
/// contain the nearest point; the others were support vertices of earlier axes. Corners of meshes join 3 to 10 edges.
pub(crate) const MAX_AXIS_VERTICES: usize = 12;

/// The number of times that the weights of a point inside a tetrahedron are corrected by their
/// error. A tetrahedron that is flat by a factor f loses f·u; two rounds recover the loss for f =
/// 1e10.
pub(crate) const WEIGHT_CORRECTION_ROUNDS: u32 = 2;

/// The largest number of points that are scanned for the farthest one. For more, [`ccd_core::Piece::extremal_point`] is used,
/// which need not scan all.
pub(crate) const MAX_SCANNED_POINTS: usize = ccd_core::tuning::MAX_SCANNED_POINTS;
