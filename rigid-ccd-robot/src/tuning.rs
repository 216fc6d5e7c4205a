//! Tuning constants. They change how long a search takes; its answer is right with any values.

/// The length of an interval, in segments of the path, at which open pairs go to the engine. Each halving costs the frames of
/// all links and a distance for each open pair; the engine costs about ten of these.
pub(crate) const MAX_ENGINE_INTERVAL_LENGTH: f64 = 1.0 / 32.0;

/// The same for the closest approach, for which the engine has to measure a distance, and not only to decide.
pub(crate) const MAX_APPROACH_INTERVAL_LENGTH: f64 = 1.0 / 64.0;

/// The displacement, in metres, below which a pair goes to the engine at once after this number of halvings.
pub(crate) const MAX_ENGINE_DISPLACEMENT: f64 = 0.01;
pub(crate) const MIN_ENGINE_HALVINGS: u32 = 4;

/// The displacement in half an interval, in metres, beyond which the distance in the middle of the interval hardly ever
/// proves it free. Pairs are then measured only if their boxes meet there.
pub(crate) const MIN_BOX_TEST_DISPLACEMENT: f64 = 0.1;

/// The squared length, in square metres, below which the offset from a centre to an obstacle's box is no first direction:
/// the centre is then nearly in the box.
pub(crate) const MIN_SQUARED_OFFSET: f64 = 1e-6;

/// The largest number of convex hulls around each connected part of an obstacle that is not convex, and around a link's body.
/// The hulls of an obstacle are found by their boxes; those of links are all compared. More hulls fit better; each costs a
/// distance, and the engine decides what they leave.
pub(crate) const MAX_OBSTACLE_PARTS: usize = 4;
pub(crate) const MAX_LINK_PARTS: usize = 1;

/// The largest number of connected parts of an obstacle that have hulls of their own.
pub(crate) const MAX_COMPONENTS: usize = 256;

/// The least number of pieces that are split into two hulls.
pub(crate) const MIN_PIECES_FOR_TWO_HULLS: usize = 16;

/// The number of intervals between the points on a joint's axis at which two links are tried.
pub(crate) const JOINT_AXIS_INTERVALS: u32 = 128;

/// How often a third of the best interval is left out then.
pub(crate) const JOINT_AXIS_REFINEMENTS: u32 = 48;

/// The number of pairs that are measured between two readings of the clock, if there is a deadline. A pair takes about 150 ns, a
/// reading 25 ns.
pub(crate) const PAIRS_BETWEEN_CLOCK_READS: usize = 8;

/// A solver that is prepared has place for so many pairs, if there are as many, in each of so many intervals that are halved. A
/// pair takes 64 bytes: the place is at most 4 MB.
pub(crate) const MAX_PREPARED_PAIRS: usize = 4096;
pub(crate) const PREPARED_HALVINGS: usize = 16;

/// The number of budgets that a question about a path takes at most for each segment, all pairs together.
pub(crate) const BUDGETS_PER_SEGMENT: u64 = 8;

/// The number of times that the interval of a pair is halved because the budget of a query does not suffice.
pub(crate) const MAX_BUDGET_SPLITS: u32 = 3;

/// The largest drift of a period of two links, as a share of the tolerance, of which the rest is left for the search.
pub(crate) const MAX_DRIFT_SHARE: f64 = 0.25;

/// The largest number of turns, of the joint that turns least, in a period of two links.
pub(crate) const MAX_TURNS_IN_PERIOD: u32 = 128;

/// The largest number of intervals of a segment over which a pair in contact at the start is followed until it has a gap.
pub(crate) const MAX_START_STEPS: u32 = 256;

/// The number of random positions of the joints between two links at which the links are looked at; the number of the nearest ones
/// from which the search for a contact goes on, and the largest number of looks of each of these searches.
pub(crate) const WITNESS_SAMPLES: usize = 256;
pub(crate) const DESCENT_STARTS: usize = 6;
pub(crate) const MAX_DESCENT_CHECKS: usize = 400;

/// The first step of such a search, as a share of a joint's range, and how often it is halved.
pub(crate) const FIRST_DESCENT_STEP: f64 = 0.125;
pub(crate) const DESCENT_HALVINGS: i32 = 10;

/// The number of boxes that are examined for each pair of links at first, and the factor from one round to the next.
pub(crate) const FIRST_ROUND_BOXES: usize = 1000;
pub(crate) const ROUND_FACTOR: usize = 4;

/// The number of boxes after which the search about a pair of links ends if the links touch without depth in the middle of each.
pub(crate) const MAX_BOXES_WITHOUT_DEPTH: usize = 4000;
