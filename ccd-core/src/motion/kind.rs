//! Kinds of relative motion. The bounds of nodes are compiled once for each kind, so that a query pays only for what
//! moves in it.

/// A kind of relative motion, as seen from the body whose node is split. What is known when the program is compiled
/// takes no instruction.
pub(crate) trait MotionKind: Copy {
    /// Whether the body turns whose node is split.
    const SPLIT_BODY: Turning;
    /// Whether the other body turns.
    const OTHER_BODY: Turning;
    /// Whether one center may accelerate relative to the other.
    const MAY_ACCELERATE: bool = false;
    /// Whether the bodies stand still in their poses. Gaps then count as closing at one unit of length per unit of
    /// time, so that free times are distances.
    const STANDS_STILL: bool = false;
}

/// What is known about the rotation of a body when the program is compiled.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Turning {
    Never,
    Always,
    AsTheQuerySays,
}

impl Turning {
    /// Returns whether the body turns, given whether that of the query does.
    #[inline(always)]
    pub(crate) fn resolve(self, query_turns: bool) -> bool {
        match self {
            Turning::Never => false,
            Turning::Always => true,
            Turning::AsTheQuerySays => query_turns,
        }
    }

    /// Returns whether the body may turn.
    #[inline(always)]
    pub(crate) fn is_possible(self) -> bool {
        self.resolve(true)
    }
}

/// Neither body turns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Straight;

impl MotionKind for Straight {
    const SPLIT_BODY: Turning = Turning::Never;
    const OTHER_BODY: Turning = Turning::Never;
}

/// Only the body turns whose node is split.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SplitBodyTurns;

impl MotionKind for SplitBodyTurns {
    const SPLIT_BODY: Turning = Turning::Always;
    const OTHER_BODY: Turning = Turning::Never;
}

/// Only the other body turns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OtherBodyTurns;

impl MotionKind for OtherBodyTurns {
    const SPLIT_BODY: Turning = Turning::Never;
    const OTHER_BODY: Turning = Turning::Always;
}

/// Both bodies turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BothTurn;

impl MotionKind for BothTurn {
    const SPLIT_BODY: Turning = Turning::Always;
    const OTHER_BODY: Turning = Turning::Always;
}

/// Any motion, also with accelerations.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AnyMotion;

impl MotionKind for AnyMotion {
    const SPLIT_BODY: Turning = Turning::AsTheQuerySays;
    const OTHER_BODY: Turning = Turning::AsTheQuerySays;
    const MAY_ACCELERATE: bool = true;
}

/// The bodies stand still in the poses of an instant of any motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StandStill;

impl MotionKind for StandStill {
    const SPLIT_BODY: Turning = Turning::AsTheQuerySays;
    const OTHER_BODY: Turning = Turning::AsTheQuerySays;
    const MAY_ACCELERATE: bool = true;
    const STANDS_STILL: bool = true;
}
