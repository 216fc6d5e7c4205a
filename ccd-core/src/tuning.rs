//! Tuning constants, which affect time, memory and the tightness of bounds, but never a proof. Answers are certified
//! with any positive value; a bad one leaves queries unresolved. Allowances that proofs rely on are in `rounding.rs`.

/// The number of point evaluations that cost as much as an iteration over a pair of nodes. An evaluation projects a
/// point of a piece onto an axis, or computes its track and rate.
pub(crate) const EVALUATIONS_WORTH_A_VISIT: u64 = 128;

/// The number of steps that a call of an oracle is assumed to take if the oracle does not count its steps. Each step
/// evaluates every point of two pieces. Searches take 3 to 10 steps.
pub(crate) const ASSUMED_ORACLE_STEPS: u64 = 8;

/// The amount of [work](crate::Stats::budgeted_work) between two readings of the clock, if there is a deadline. A reading takes
/// about 25 ns, and a visit ten times as long: a deadline is overstepped by about 2 µs.
pub(crate) const WORK_BETWEEN_CLOCK_READS: u64 = 8;

/// The largest difference between distances in a period and in the searched period that represents it, as a share of
/// the tolerance, for bodies that turn many times. A contact in the searched period is then a contact of the bodies.
/// The rest of the tolerance suffices for the search. Twice this share is reserved, for rounding and for the change
/// together.
pub(crate) const MAX_PERIOD_DISTANCE_CHANGE_SHARE: f64 = 0.25;

/// The largest share of the duration that the searched periods of repeating motions may take together. If they take
/// more, the whole duration is searched at once.
pub(crate) const MAX_SEARCHED_DURATION_SHARE: f64 = 0.5;

/// The share of the gap along a fixed plane that rotation must use up for a plane that turns with the body to be tried.
/// Measured: pieces as small as those of common meshes stay far below, large ones that turn past small ones are far
/// above.
pub(crate) const MIN_ROTATION_GAP_SHARE: f64 = 0.5;

/// The number of alternating projections between the boxes of two bodies, which approximate the nearest points of the
/// boxes. Any axis is sound. Measured on 283 pairs of falling bodies: 1, 2, 3, 6 and 12 projections prove 19, 20, 22,
/// 24 and 24 of them apart.
pub(crate) const ALTERNATING_PROJECTION_COUNT: usize = 3;

/// The largest number of Newton steps towards the time at which a gap closes along one axis; after them the oracle is
/// called again. A step cannot overshoot, so a few suffice.
pub(crate) const MAX_NEWTON_STEPS: usize = 16;

/// The free time above which the first visit of two pieces tries no better separating plane, in units of the duration.
/// Measured: pairs of knots are visited 2 % more often, and a first visit takes half of the time.
pub(crate) const SUFFICIENT_FIRST_FREE_TIME: f64 = 1.0 / 65536.0;

/// The least share of a gap that has to be closed by the present rate alone, not by its change, for the time in closed
/// form to be used. Otherwise the points are followed, and the time is longer.
pub(crate) const MIN_CLOSED_BY_RATE_SHARE: f64 = 0.75;

/// The largest number of distance measurements in each of two phases of the search for the time of closest approach of
/// two pieces. The first phase brackets the time between two clocks, the second narrows the bracket. Each measurement
/// may halve the interval; a few suffice for smooth distances. No answer depends on it.
pub(crate) const MAX_FOLLOW_MEASUREMENTS: usize = 16;

/// The largest deviation of bodies from the motions that approximate their trajectories at which a contact is accepted,
/// as a share of the tolerance. Four times that share is lost. Half of the tolerance is for the gap that the motions
/// keep, and the other half for the contact that they show; each half loses the deviations twice.
pub(crate) const MAX_DEVIATION_SHARE: f64 = 0.125;

/// The least tolerance of a search with approximate motions, in units of their deviations from the trajectories.
pub(crate) const MIN_TOLERANCE_PER_DEVIATION: f64 = 1.0 / 16.0;

/// A stretch is cut before it is searched if its deviation from the trajectories exceeds that of the adjacent proven
/// stretch by this factor. The bodies are measured at the common end, which costs less than a failure. Twice the length
/// has at most 8 times the deviation.
pub(crate) const CUT_DEVIATION_RATIO: f64 = 16.0;

/// The length above which a stretch of time is halved without a measurement of the distance, as a share of the
/// duration. Measured: over 90 scenes of curves and links the closest approach takes 0.77 of the visits of halves
/// alone. With measurements in long stretches as well it takes 1.02 of them, and in the worst scene 51 times as many.
pub(crate) const MIN_UNMEASURED_HALVING_LENGTH_SHARE: f64 = 0.125;

/// The estimated length below which a stretch of time is cut to that length before it is searched, as a share of the
/// stretch.
pub(crate) const MAX_CUT_LENGTH_SHARE: f64 = 0.75;

/// The least length of a part that is cut off a stretch of time, as a share of the stretch. This takes fewer cuts than
/// many halves, but the length is an estimate.
pub(crate) const MIN_CUT_LENGTH_SHARE: f64 = 1.0 / 1024.0;

/// The largest number of parts of a query that have a budget of their own. The parts are between the corners of its
/// trajectories. If there are more, some share one: a trajectory of a user may have any number of corners.
pub(crate) const MAX_BUDGET_PARTS: usize = 1 << 16;

/// The longest step in time when the distance of two pieces is followed to a minimum, measured by the sum of both
/// bodies' rotations in radians. The distance usually has at most one minimum within such a step.
pub(crate) const MAX_FOLLOW_ROTATION: f64 = 0.25;

/// The largest number of times at which the bodies are measured to estimate their closest approach.
pub(crate) const MAX_INITIAL_MEASUREMENTS: usize = 4;

/// The accuracy of the least distance of two pieces that are followed over time, in units of the tolerance.
pub(crate) const FOLLOW_TOLERANCE_SHARE: f64 = 1.0 / 8.0;

/// The relative increase of a free time by one Newton step above which another step is made.
pub(crate) const MIN_NEWTON_GROWTH: f64 = 1.0 / 64.0;

/// The slack above which a pair of pieces in contact at the start is advanced further, in units of the distance's
/// rounding. The slack is the excess of the gap over the required gap. It is a part of
/// [`MIN_APPROACH_PER_ROUNDING`](crate::rounding::MIN_APPROACH_PER_ROUNDING). Below it is the rounding of heights: each visit would find
/// some of it again, and a slowly approaching pair would be visited a million times before it is in contact.
pub(crate) const RESTING_SLACK_PER_ROUNDING: f64 = 1.0 / 16.0;

/// The distance of two nodes beyond which the pair is advanced once more rather than split, in units of the sum of
/// their radii. Measured: 0.5 to 1 suit meshes on meshes as well as meshes on a thin board. A smaller value makes large
/// nodes creep past each other, a larger one splits nodes that only pass.
pub(crate) const MIN_REVISIT_DISTANCE_RATIO: f32 = 0.7;

/// The share of a node's radius that is added to its thickness when the thicker of two nodes is chosen for a split. It
/// lets flat nodes that are seen edge-on be split as well.
pub(crate) const ADDED_THICKNESS_PER_RADIUS: f32 = 0.5;

/// The ratio of the radius of a triangle, or of a group of triangles, to that of the node beside it above which the
/// triangles' edges are sought for the points between which a separating axis is tried. Beside other triangles, their
/// centers suffice: meshes of similar triangles take 1 % more visits, each of them up to a tenth cheaper. Centers alone
/// would take three times as many for a figure on a board of 12 triangles.
pub(crate) const MIN_LARGE_TRIANGLE_RATIO: f32 = 4.0;

/// The least height of a triangle that is not thin, in units of its longest edge. The centers of two slivers say nothing
/// about the way between them.
pub(crate) const MIN_HEIGHT_OF_FULL_TRIANGLE: f64 = 0.25;

/// The longest time for which a separating plane that turns with a body is used, as a share of the duration. The bounds
/// along the plane have to cover the motion of the bodies in that time.
pub(crate) const MAX_TURNING_PLANE_TIME: f32 = 1.0 / 16.0;

/// The ratio of two nodes' radii above which a plane that turns with the larger node is tried.
pub(crate) const MIN_TURNING_PLANE_RADIUS_RATIO: f32 = 3.0;

/// The distance that a large turning node moves past a small node, beyond which the pair is advanced once more rather
/// than split, in units of the large node's radius. It is the distance during the certified time. The children of the
/// large node would be swept past all the same. Measured on discs and on soups of large triangles.
pub(crate) const MIN_REVISIT_SWEEP: f32 = 1.0 / 128.0;

/// The largest number of rays that are tried to compute the winding number of a surface about a point. A ray fails if
/// it passes an edge by less than rounding: one in 10⁸ does, even of a million triangles.
pub(crate) const MAX_RAYS: u32 = 32;

/// The excess of a gap of nodes over the required gap up to which the gap counts as closed, in units of the tolerance.
/// The rest that rounding leaves of a gap at the end of a clock is not worth another clock, and a pair that inherits
/// its parent's clock is examined before all others.
pub(crate) const CLOSED_GAP_TOLERANCE_SHARE: f64 = 1.0 / 16.0;

/// The largest number of corners of the polytope that is grown inside the Minkowski difference of two pieces to decide
/// whether they intersect. Each corner improves the least depth found. A few tens were enough for pieces of a thousand
/// corners that begin to overlap.
pub(crate) const MAX_EXPANDING_POLYTOPE_CORNERS: usize = 256;

/// The depths below a flat piece at which a point inside its solid is sought, in this order, in units of the piece's
/// size. The first is far above the distance at which a point counts as off the surface; the others reach inside
/// thinner walls.
pub(crate) const INTERIOR_PROBE_DEPTHS: [f64; 4] = [1e-4, 1e-6, 1e-9, 1e-12];

/// The ratio of the distances of two sibling pairs of the front to the bodies' distance, from which on a descent tries
/// to join the pairs. It tries again once the bodies' distance has shrunk by the same factor. Joining saves measuring
/// both pairs, and costs measuring one more.
#[cfg(feature = "hull-tree")]
pub(crate) const JOIN_DISTANCE_RATIO: f64 = 2.0;

/// The depth of overlap of two hulls beyond which the schedule `Fast` splits them without a measurement. It is along
/// the axis between their middles, in units of the smaller one's radius. No answer depends on it. A smaller value
/// splits hulls that have a distance, a larger one searches for common points in vain. Measured on rings and bunnies
/// that fall: a half takes two thirds of the time on rings, where hulls overlap, and costs nothing on bunnies; a
/// quarter measures a seventh more pairs of bunnies.
#[cfg(feature = "hull-tree")]
pub(crate) const MIN_OVERLAP_TO_SPLIT: f64 = 0.5;

/// The largest number of points of a piece that are scanned for an extremal point; for more points, edges are climbed.
/// Measured on hulls of random points of a sphere, in random directions, by `cargo bench -p ccd-bench --bench support`:
/// 46 ns against 40 ns for 16 corners, 56 against 48 for 32, 90 against 51 for 64, 255 against 50 for 256, 4,400
/// against 116 for 4,096. Climbing from the last corner takes 30 to 47 ns throughout. Up to 32 a table is not worth its
/// memory.
pub const MAX_SCANNED_POINTS: usize = 32;

/// The share of a convex body's bounding box that the body must fill to be searched as one piece, rather than as the
/// triangles of its surface. Measured: a board of 8 corners under 38,000 triangles takes 29 visits as one box and 41 as
/// twelve triangles; a tetrahedron, a third of its box, against 26,000 triangles takes 7,500 as one piece and 130 as
/// four triangles.
pub(crate) const MIN_BOX_FILL: f64 = 0.9;

/// The largest number of corners of equal height, up to rounding, that a climb visits; after them all corners of the
/// piece are scanned.
pub(crate) const MAX_PLATEAU_POINTS: usize = 32;

/// The distance from a facet up to which a nearest point counts as on the facet, in units of the piece's size. It only
/// decides which feature a contact names. Nearest points are combinations of corners, off by a few
/// [`UNIT_ROUNDOFF_F64`](crate::rounding::UNIT_ROUNDOFF_F64) of that size, and oracles find them to 1e-13 of it. With a
/// larger value, a point of a virtual facet next to a corner is said to be on a face that it is off.
pub(crate) const POINT_ON_FACET_TOLERANCE: f64 = 1e-12;

/// The angle below which a Jacobi rotation is skipped when principal axes are computed, in radians.
///
/// Unit: radians. Axes are rounded to f32, which turns them by up to 6e-8.
pub(crate) const MIN_JACOBI_ANGLE: f64 = 1e-7;

/// The largest thickness of a flat node, in units of its size. Coordinates of a plane are rounded by about `u` of their
/// own, which is larger far from the origin. A larger value adds slabs that prove little; a smaller one leaves flat
/// contact to f32.
pub(crate) const MAX_FLAT_THICKNESS: f64 = 1e-9;

/// The ratio of the rounding of a node gap in f32 to the gap at which clocks of nodes stop, above which the node gap is
/// computed in f64 instead. Clocks stop at the margin plus a [share](crate::rounding::NODE_GAP_TOLERANCE_SHARE) of the
/// tolerance. Below the ratio f32 proves as much as f64.
pub(crate) const F64_FALLBACK_THRESHOLD: f64 = 1.0;

/// The largest sideways displacement of a screw's axis during the query at which nodes are compared along the screw, in
/// units of the smaller body's radius. Surfaces that turn with the screw prove nothing for long beyond it.
pub(crate) const MAX_SCREW_DRIFT: f64 = 1.0 / 256.0;

/// The advance along a screw's axis during the query up to which the motion counts as a pure rotation, in units of the
/// smaller body's radius. With a smaller pitch, nodes would span many pitches.
pub(crate) const MIN_SCREW_ADVANCE: f64 = 1.0 / 65536.0;

/// The least distance of a node from the axis of a screw, as a share of the distance of the node's center, for which
/// its bounds in screw coordinates are computed. Nodes that extend nearer have profiles too wide to prove anything.
pub(crate) const MIN_PROFILE_DISTANCE_SHARE: f64 = 0.25;

/// The number of splits in a search after which nodes are compared along a screw. Profiles of nodes are worth their
/// cost to long queries only.
pub(crate) const SPLITS_BEFORE_SCREW: u64 = 512;

/// The largest number of a node's triangles to which the axes of its box are fitted. The box is then made to enclose
/// all triangles of the node.
///
/// Unit: triangles. Smaller: boxes grow; at 16 queries visit a percent more nodes. Larger: longer to build, boxes
/// hardly shrink.
pub(crate) const MAX_SAMPLED_TRIANGLES: usize = 64;

/// The rate at which a gap counts as closing if it opens, for the comparison of separating axes.
///
/// Unit: lengths of the scene per duration. It is small beside any motion, and the quotient of a gap and this rate does
/// not overflow in f32 for gaps up to 3e20.
pub(crate) const LEAST_CLOSING_RATE: f32 = 1e-18;
