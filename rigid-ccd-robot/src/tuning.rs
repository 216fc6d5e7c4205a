//! Tuning constants. They affect only the running time of a search, not the correctness of its answer.

/// The interval length, in segments, at which undecided candidates are left to the engine. Each halving costs the
/// frames of all links and a distance query for each candidate. An engine query costs about ten distance queries.
pub(crate) const MAX_ENGINE_INTERVAL_LENGTH: f64 = 1.0 / 32.0;

/// The same for the closest approach, for which the engine has to measure distances instead of comparing them.
pub(crate) const MAX_APPROACH_INTERVAL_LENGTH: f64 = 1.0 / 64.0;

/// Below this displacement, in metres, a pair is left to the engine after only [`MIN_ENGINE_HALVINGS`] halvings.
pub(crate) const MAX_ENGINE_DISPLACEMENT: f64 = 0.01;
pub(crate) const MIN_ENGINE_HALVINGS: u32 = 4;

/// Above this displacement in half an interval, in metres, a distance at the midpoint rarely proves a pair free. The
/// pair is then measured only if its bounding boxes intersect there.
pub(crate) const MIN_BOX_TEST_DISPLACEMENT: f64 = 0.1;

/// The squared distance, in square metres, below which a center counts as inside an obstacle's box. The offset between
/// the two is then no initial direction.
pub(crate) const MIN_SQUARED_OFFSET: f64 = 1e-6;

/// The largest number of convex hulls around each component of a non-convex obstacle, and around a link's body. A box
/// test finds the hulls of obstacles, but all hulls of links are compared. More hulls fit better and leave less to the
/// engine, but each costs distance queries.
pub(crate) const MAX_OBSTACLE_PARTS: usize = 4;
pub(crate) const MAX_LINK_PARTS: usize = 1;

/// The largest number of components of an obstacle that get hulls of their own.
pub(crate) const MAX_COMPONENTS: usize = 256;

/// The smallest number of pieces that are divided between two hulls.
pub(crate) const MIN_PIECES_FOR_TWO_HULLS: usize = 16;

/// The number of intervals between the sampled points of a joint axis, in the search for a point that two links share.
pub(crate) const JOINT_AXIS_INTERVALS: u32 = 128;

/// The number of refinements after the sampling. Each drops a third of the interval.
pub(crate) const JOINT_AXIS_REFINEMENTS: u32 = 48;

/// The number of pairs between two readings of the clock, if there is a deadline. Measuring a pair takes about 150 ns,
/// reading the clock 25 ns.
pub(crate) const PAIRS_BETWEEN_CLOCK_READS: usize = 8;

/// The numbers of pairs and of nested halvings for which a prepared solver allocates memory. A pair takes 64 bytes, so
/// this is at most 4 MB.
pub(crate) const MAX_PREPARED_PAIRS: usize = 4096;
pub(crate) const PREPARED_HALVINGS: usize = 16;

/// The largest number of budgets that a question about a path uses for each segment.
pub(crate) const BUDGETS_PER_SEGMENT: u64 = 8;

/// How often the interval of a candidate is halved after the budget of a query did not suffice.
pub(crate) const MAX_BUDGET_SPLITS: u32 = 3;

/// The largest drift of a period, as a fraction of the tolerance. The rest of the tolerance is left to the search.
pub(crate) const MAX_DRIFT_SHARE: f64 = 0.25;

/// The largest number of turns that the slowest joint makes in a period.
pub(crate) const MAX_TURNS_IN_PERIOD: u32 = 128;

/// The largest number of steps in a segment for following a pair in contact at the start until it has a gap.
pub(crate) const MAX_START_STEPS: u32 = 256;

/// The number of random samples in the search for witnesses, the number of the nearest samples from which it descends,
/// and the largest number of checks in each descent.
pub(crate) const WITNESS_SAMPLES: usize = 256;
pub(crate) const DESCENT_STARTS: usize = 6;
pub(crate) const MAX_DESCENT_CHECKS: usize = 400;

/// The initial step of a descent, as a fraction of a joint's range, and the number of times that it is halved.
pub(crate) const FIRST_DESCENT_STEP: f64 = 0.125;
pub(crate) const DESCENT_HALVINGS: i32 = 10;

/// The number of boxes for each pair of links in the first round, and the factor from round to round.
pub(crate) const FIRST_ROUND_BOXES: usize = 1000;
pub(crate) const ROUND_FACTOR: usize = 4;

/// After this number of boxes, the search for a pair of links ends if they touched without overlapping at every
/// center.
pub(crate) const MAX_BOXES_WITHOUT_DEPTH: usize = 4000;
