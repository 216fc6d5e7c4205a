//! Tuning constants. They affect only the running time of a search, not the correctness of its answer.

/// The length of an interval, in segments, at which the search leaves undecided candidates to the engine. Each halving
/// computes the frames of all links, and takes one distance query for each candidate. An engine query takes as long as
/// about ten distance queries.
pub(crate) const MAX_ENGINE_INTERVAL_LENGTH: f64 = 1.0 / 32.0;

/// The length of such an interval in a search for the closest approach. The engine then has to measure distances,
/// instead of only comparing them with a margin.
pub(crate) const MAX_APPROACH_INTERVAL_LENGTH: f64 = 1.0 / 64.0;

/// A pair whose displacement in an interval is smaller than this, in metres, is left to the engine after only
/// [`MIN_ENGINE_HALVINGS`] halvings.
pub(crate) const MAX_ENGINE_DISPLACEMENT: f64 = 0.01;
pub(crate) const MIN_ENGINE_HALVINGS: u32 = 4;

/// If the displacement of a pair in half an interval is larger than this, in metres, its distance at the midpoint
/// rarely proves it free. The distance is then measured only if the bounding boxes intersect there.
pub(crate) const MIN_BOX_TEST_DISPLACEMENT: f64 = 0.1;

/// The squared distance, in square metres, below which a part's center counts as inside an obstacle's box. A distance
/// query then starts along the line between both centers, not towards the box.
pub(crate) const MIN_SQUARED_OFFSET: f64 = 1e-6;

/// The largest number of convex hulls around each component of a non-convex obstacle, and around a link's body. More
/// hulls fit better and leave less to the engine, but each hull takes distance queries. Links get fewer hulls, because
/// box tests exclude only pairs with an obstacle.
pub(crate) const MAX_OBSTACLE_PARTS: usize = 4;
pub(crate) const MAX_LINK_PARTS: usize = 1;

/// The largest number of components of an obstacle for which each component has separate hulls.
pub(crate) const MAX_COMPONENTS: usize = 256;

/// The smallest number of pieces for which a component gets more than one hull.
pub(crate) const MIN_PIECES_FOR_TWO_HULLS: usize = 16;

/// The number of intervals between the sampled points of a joint axis, in the search for a point that two links share.
pub(crate) const JOINT_AXIS_INTERVALS: u32 = 128;

/// The number of refinements after the sampling. Each refinement drops a third of the interval.
pub(crate) const JOINT_AXIS_REFINEMENTS: u32 = 48;

/// The number of pairs that are measured between two readings of the clock. Measuring a pair takes about 150 ns,
/// reading the clock about 25 ns.
pub(crate) const PAIRS_BETWEEN_CLOCK_READS: usize = 8;

/// The numbers of pairs and of nested halvings for which a prepared solver allocates memory. A pair takes 64 bytes, so
/// this is at most 4 MB.
pub(crate) const MAX_PREPARED_PAIRS: usize = 4096;
pub(crate) const PREPARED_HALVINGS: usize = 16;

/// The largest number of budgets that a question about a path uses for each segment.
pub(crate) const BUDGETS_PER_SEGMENT: u64 = 8;

/// How many times the interval of a candidate is halved if the budget of a query does not suffice.
pub(crate) const MAX_BUDGET_SPLITS: u32 = 3;

/// The largest drift of a period, as a fraction of the tolerance. The search uses the rest of the tolerance.
pub(crate) const MAX_DRIFT_SHARE: f64 = 0.25;

/// The largest number of turns that the slowest joint makes in a period.
pub(crate) const MAX_TURNS_IN_PERIOD: u32 = 128;

/// The largest number of steps in a segment in which a pair in contact at the start is followed until it has a gap.
pub(crate) const MAX_START_STEPS: u32 = 256;

/// In the search for witnesses: the number of random samples, the number of descents, which start at the samples with
/// the least distances, and the largest number of checks in each descent.
pub(crate) const WITNESS_SAMPLES: usize = 256;
pub(crate) const DESCENT_STARTS: usize = 6;
pub(crate) const MAX_DESCENT_CHECKS: usize = 400;

/// The initial step of a descent, as a fraction of a joint's range, and the number of times that it is halved.
pub(crate) const FIRST_DESCENT_STEP: f64 = 0.125;
pub(crate) const DESCENT_HALVINGS: i32 = 10;

/// The largest number of boxes for each pair of links in the first round, and the factor by which it grows from round to
/// round.
pub(crate) const FIRST_ROUND_BOXES: usize = 1000;
pub(crate) const ROUND_FACTOR: usize = 4;

/// The number of boxes after which the search for a pair of links ends, if the links touch without overlapping at the
/// center of every box so far.
pub(crate) const MAX_BOXES_WITHOUT_DEPTH: usize = 4000;

/// The mean number of balls that cover a part of a robot. More balls fit better and leave fewer intervals open, but
/// each is tested against all obstacles near it.
pub(crate) const BALLS_PER_PART: f64 = 2.5;

/// A piece of a part is cut in two if the larger ball of both halves is smaller than this fraction of its own ball.
pub(crate) const LEAST_CUT_GAIN: f64 = 0.95;

/// The numbers of steps in which the center of a ball is found: of a ball that is used, and of one that is compared.
pub(crate) const BALL_STEPS: u32 = 300;
pub(crate) const TRIAL_BALL_STEPS: u32 = 8;

/// The number of polygons, give or take a factor of two, whose corners a ball that is compared is found for.
pub(crate) const TRIAL_POLYGONS: usize = 64;

/// The largest number of cells of all tables of distances together, and the distance beyond which tables are not
/// accurate, in metres.
pub(crate) const MAX_TABLE_CELLS: usize = 1 << 15;
pub(crate) const MAX_TABLE_DISTANCE: f64 = 0.5;

/// The displacement of a ball, in metres, from which an interval that it leaves open is divided again, and how often.
pub(crate) const MIN_DIVIDED_DISPLACEMENT: f32 = 0.012;
pub(crate) const MAX_DIVISIONS: u32 = 2;

/// The largest error of the ball test in f32, as a fraction of the largest ball. Beyond it the test proves little.
pub(crate) const MAX_BALL_TEST_ERROR: f64 = 0.05;

/// The radius of the largest ball, in metres, below which the ball test is not used: squares of such lengths in f32 are
/// still far from the least numbers.
pub(crate) const MIN_BALL_TEST_RADIUS: f64 = 1e-9;

/// The largest number of steps along a pair's open interval before the search by halving takes over.
pub(crate) const MAX_ADVANCES: usize = 48;

/// How often a contact may be found in the same intervals before the search by halving looks for an earlier one.
pub(crate) const MAX_TESTS_BEFORE_CONTACT: u32 = 2;

/// Distances in tables, and distances from which steps along an open interval begin, are measured to within this fraction.
pub(crate) const TABLE_ACCURACY: f64 = 0.9;
pub(crate) const ADVANCE_ACCURACY: f64 = 0.9;

/// The same for a least distance, whose gaps are often as small as the tolerance.
pub(crate) const LEAST_DISTANCE_ACCURACY: f64 = 0.5;

/// The factor by which the distance grows within which the nearest pair is sought. It begins with the largest ball's
/// radius.
pub(crate) const NEAREST_PAIR_GROWTH: f64 = 4.0;

/// The largest number of segments at constant rates that are tested together. The segments after a contact are tested in
/// vain.
pub(crate) const MAX_SEGMENTS_AT_ONCE: f64 = 64.0;

/// The number of the last open intervals among which an adjacent one of the same pair is sought.
pub(crate) const MERGED_INTERVALS: usize = 16;
