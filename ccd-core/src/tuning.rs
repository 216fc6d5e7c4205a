//! Tuning constants, which cost time, memory or tightness, and never affect a proof. Answers are certified with any
//! positive value; a bad one leaves queries unresolved. Allowances that proofs rely on are in `rounding.rs`.

/// The number of point evaluations that cost as much as an iteration over a pair of nodes. An evaluation projects a
/// point of a piece onto an axis, or computes its track and rate.
pub const EVALUATIONS_PER_VISIT: u64 = 128;

/// The assumed number of steps of an oracle that does not count them. Each step evaluates every point of two pieces.
/// Searches take 3 to 10 steps.
pub const ASSUMED_ORACLE_STEPS: u64 = 8;

/// The amount of [work](crate::Stats::work) between two readings of the clock, if there is a deadline. A reading takes
/// about 25 ns.
pub const WORK_BETWEEN_CLOCK_READS: u64 = 256;

/// The share of the tolerance by which distances may differ between periods that are represented by one period, for
/// bodies that turn many times. A contact in the searched period is then a contact of the bodies. The rest of the
/// tolerance suffices for the search. Twice this share is reserved, for rounding and for the change together.
pub const PERIOD_CHANGE_SHARE: f64 = 0.25;

/// The largest share of the duration that a search period by period may have to search. If it is more, the whole
/// duration is searched at once.
pub const MAX_PERIOD_SHARE: f64 = 0.5;

/// The share of a gap that the rotation of a piece past a fixed plane has to use up before a plane that turns with the
/// piece is tried. Measured: pieces as small as those of common meshes stay far below, large ones that turn past small
/// ones are far above.
pub const ROTATION_GAP_SHARE: f64 = 0.5;

/// The number of alternating projections between the boxes of two bodies when their nearest points are sought. Any axis
/// is sound. Measured on 283 pairs of falling bodies: 1, 2, 3, 6 and 12 projections prove 19, 20, 22, 24 and 24 of them
/// apart.
pub const BOX_PROJECTION_COUNT: usize = 3;

/// The largest number of Newton steps for the time at which a gap closes along one axis, before the oracle is called
/// again. A step cannot overshoot, so a few suffice.
pub const MAX_NEWTON_STEPS: usize = 16;

/// The free time at the first visit of two pieces above which no better plane is tried, in units of the duration.
/// Measured: pairs of knots are visited 2 % more often, and a first visit takes half of the time.
pub const SUFFICIENT_FIRST_FREE_TIME: f64 = 1.0 / 65536.0;

/// The largest number of distance measurements when the time of closest approach of two pieces is sought. It applies to
/// each of two phases: before that time is between two clocks, and after. Each measurement may halve the interval; a
/// few suffice for smooth distances. No answer depends on it.
pub const MAX_FOLLOW_MEASUREMENTS: usize = 16;

/// The share of the tolerance by which bodies may deviate from the motions that approximate their trajectories, at a
/// contact. Four times that share is lost. Half of the tolerance is for the gap that the motions keep, and the other
/// half for the contact that they show; each half loses the deviations twice.
pub const DEVIATION_SHARE: f64 = 0.125;

/// The tolerance for distances of approximate motions, in units of their deviations from the trajectories.
pub const TOLERANCE_PER_DEVIATION: f64 = 1.0 / 16.0;

/// The ratio of deviations above which a stretch of time next to a proven one is cut before it is searched. The bodies
/// are measured at the common end, which costs less than a failure. Twice the length has at most 8 times the deviation.
pub const CUT_DEVIATION_RATIO: f64 = 16.0;

/// The share of the duration above which stretches of time are halved, without a measurement of the distance. Measured:
/// over 90 scenes of curves and links the closest approach takes 0.77 of the visits of halves alone. With measurements
/// in long stretches as well it takes 1.02 of them, and in the worst scene 51 times as many.
pub const MIN_UNMEASURED_SHARE: f64 = 0.125;

/// The share of a stretch of time below which an estimated length is worth a cut, before the stretch is searched.
pub const MAX_CUT_SHARE: f64 = 0.75;

/// The least share of a stretch of time that is cut off. This takes fewer cuts than many halves, but the length is an
/// estimate.
pub const MIN_CUT_SHARE: f64 = 1.0 / 1024.0;

/// The largest number of parts of a query that have a budget of their own. The parts are between the corners of its
/// trajectories. If there are more, some share one: a trajectory of a user may have any number of corners.
pub const MAX_BUDGET_PARTS: usize = 1 << 16;

/// The longest step when tracking the distance of two pieces, in radians of both bodies' rotations together. The
/// distance usually has at most one minimum within it.
pub const MAX_FOLLOW_ROTATION: f64 = 0.25;

/// The largest number of times at which the bodies are measured to estimate their closest approach.
pub const MAX_INITIAL_MEASUREMENTS: usize = 4;

/// The accuracy of the least distance of two pieces that are followed over time, in units of the tolerance.
pub const FOLLOW_ACCURACY: f64 = 1.0 / 8.0;

/// The least relative growth of a free time for which another Newton step is made.
pub const MIN_NEWTON_GROWTH: f64 = 1.0 / 64.0;

/// The slack that a pair in contact at the start must have to be advanced further, in units of the distance's rounding.
/// It is a part of [`RESTING_DECREASE`](crate::rounding::RESTING_DECREASE). Below it is the rounding of heights: each visit would find
/// some of it again, and a slowly approaching pair would be visited a million times before it is in contact.
pub const MIN_RESTING_SLACK: f64 = 1.0 / 16.0;

/// The distance of two nodes, in units of their radii, beyond which a second visit is worth more than a split.
/// Measured: 0.5 suits meshes on meshes as well as meshes on a thin board. A smaller value makes large nodes creep
/// past each other, a larger one splits nodes that only pass.
pub const REVISIT_DISTANCE: f32 = 0.5;

/// The share of a node's radius that is added to its thickness along any axis when the thicker of two nodes is chosen
/// for a split. It lets flat nodes that are seen edge-on be split as well.
pub const ADDED_THICKNESS: f32 = 0.1;

/// The longest time for which a bound along a plane that turns with a body is used, in units of the duration. The bound
/// has to cover the motion of the bodies in that time.
pub const MAX_TURNING_PLANE_TIME: f32 = 1.0 / 16.0;

/// The ratio of two nodes' radii above which a plane that turns with the larger node is tried.
pub const MUCH_LARGER_RATIO: f32 = 3.0;

/// The distance that a large turning node must sweep past a small one for a second visit to be worth more than a split,
/// in units of its radius. It is the distance during the certified time. The children of the large node would be swept
/// past all the same. Measured on discs and on soups of large triangles.
pub const MIN_SWEEP: f32 = 1.0 / 128.0;

/// The number of rays that are tried to compute the winding number of a surface about a point. A ray fails if it passes
/// an edge by less than rounding: one in 10⁸ does, even of a million triangles.
pub const MAX_RAYS: u32 = 32;

/// The excess over the required gap up to which a gap of nodes counts as closed, in units of the tolerance. The rest
/// that rounding leaves of a gap at the end of a clock is not worth another clock, and a pair that inherits its
/// parent's clock is examined before all others.
pub const CLOSED_GAP: f64 = 1.0 / 16.0;

/// The largest number of corners of the polytope inside the difference of two pieces, which is grown to decide whether
/// the pieces intersect. Each corner improves the least depth found. A few tens were enough for pieces of a thousand
/// corners that begin to overlap.
pub const MAX_INNER_POLYTOPE_CORNERS: usize = 256;

/// The depths below a flat piece at which a point inside its solid is sought, in this order, in units of the piece's
/// size. The first is far above the distance at which a point counts as off the surface; the others reach inside
/// thinner walls.
pub const INTERIOR_PROBE_DEPTHS: [f64; 4] = [1e-4, 1e-6, 1e-9, 1e-12];

/// The ratio to the bodies' distance that the distances of two pairs of a front must exceed before a descent tries to
/// join them. It tries again once the bodies' distance has shrunk by the same factor. Joining saves measuring both
/// pairs, and costs measuring one more.
pub const JOIN_DISTANCE_RATIO: f64 = 2.0;

/// The depth of overlap of two hulls beyond which the schedule `Fast` splits them without a measurement. It is along
/// the axis between their middles, in units of the smaller one's radius. No answer depends on it. A smaller value
/// splits hulls that have a distance, a larger one searches for common points in vain. Measured on rings and bunnies
/// that fall: a half takes two thirds of the time on rings, where hulls overlap, and costs nothing on bunnies; a
/// quarter measures a seventh more pairs of bunnies.
pub const SPLIT_OVERLAP: f64 = 0.5;

/// The largest number of points of a piece that are scanned for an extremal point; for more points, edges are climbed.
/// Measured on hulls of random points of a sphere, in random directions, by `cargo bench -p ccd-bench --bench support`:
/// 46 ns against 40 ns for 16 corners, 56 against 48 for 32, 90 against 51 for 64, 255 against 50 for 256, 4,400
/// against 116 for 4,096. Climbing from the last corner takes 30 to 47 ns throughout. Up to 32 a table is not worth its
/// memory.
pub const MAX_SCANNED_POINTS: usize = 32;

/// The share of its bounding box that a convex body has to fill for it to be searched as one piece, rather than as the
/// triangles of its surface. Measured: a board of 8 corners under 38,000 triangles takes 29 visits as one box and 41 as
/// twelve triangles; a tetrahedron, a third of its box, against 26,000 triangles takes 7,500 as one piece and 130 as
/// four triangles.
pub const MIN_BOX_FILL: f64 = 0.9;

/// The number of corners of equal height, up to rounding, that a climb visits before all corners of the piece are
/// scanned.
pub const MAX_PLATEAU_POINTS: usize = 32;

/// The distance from a facet up to which a nearest point counts as on it, in units of the piece's size. It only decides
/// which feature a contact names. Nearest points are combinations of corners, off by a few
/// [`UNIT_ROUNDOFF_F64`](crate::rounding::UNIT_ROUNDOFF_F64) of that size, which a flat piece magnifies.
pub const FACET_TOLERANCE: f64 = 1e-9;

/// The angle below which a Jacobi rotation is skipped when principal axes are computed, in radians.
///
/// Unit: radians. Axes are rounded to f32, which turns them by up to 6e-8.
pub const MIN_JACOBI_ANGLE: f64 = 1e-7;

/// The largest thickness of a flat node, in units of its size. Coordinates of a plane are rounded by about `u` of their
/// own, which is larger far from the origin. A larger value adds slabs that prove little; a smaller one leaves flat
/// contact to f32.
pub const MAX_FLAT_THICKNESS: f64 = 1e-9;

/// The rounding of the gap of nodes in f32 above which the gap is computed in f64, in units of the gap at which clocks
/// of nodes stop. Below it f32 proves as much as f64.
pub const MIN_ROUNDING_FOR_F64: f64 = 1.0;

/// The largest sideways speed of the axis of a screw at which nodes are compared along it, per unit of the duration and
/// of the smaller body's radius. Surfaces that turn with the screw prove nothing for long beyond it.
pub const MAX_SCREW_DRIFT: f64 = 1.0 / 256.0;

/// The advance of a screw during the query up to which it counts as no advance, in units of the smaller body's radius.
/// With a smaller pitch, nodes would span many pitches.
pub const MIN_SCREW_ADVANCE: f64 = 1.0 / 65536.0;

/// The least distance of a node from the axis of a screw for which a profile is computed, in units of the distance of
/// the node's centre. Nodes that extend nearer have profiles too wide to prove anything.
pub const MIN_PROFILE_RADIUS: f64 = 0.25;

/// The number of splits after which nodes are compared along a screw: profiles of nodes are worth their cost to long
/// queries only.
pub const SPLITS_BEFORE_SCREW: u64 = 512;

/// The largest number of triangles of a node from which the frame of its box is chosen; the box then contains all of
/// them.
///
/// Unit: triangles. Smaller: boxes grow; at 16 queries visit a percent more nodes. Larger: longer
/// to build, boxes hardly shrink.
pub const MAX_SAMPLED_TRIANGLES: usize = 64;
