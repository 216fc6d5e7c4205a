//! Kinds of relative motion. The bounds of nodes are compiled once for each kind, so that a query pays only for what
//! moves in it.

/// A kind of relative motion, as seen from the body whose node is split. What is known when the program is compiled
/// takes no instruction.
pub(crate) trait MotionKind: Copy {
    /// Whether both bodies may turn.
    const BOTH_MAY_TURN: bool;
    /// Whether one centre may accelerate relative to the other.
    const MAY_ACCELERATE: bool;
    /// Whether the bodies stand still in their poses. Gaps then count as closing at one unit of length per unit of
    /// time, so that free times are distances.
    const STANDS_STILL: bool;

    /// Returns whether the body turns whose node is split, given that of the query's body.
    fn does_split_body_turn(turns: bool) -> bool;

    /// Returns whether the other body turns, given that of the query's body.
    fn does_other_body_turn(turns: bool) -> bool;
}

/// Defines kinds of motion that are known when the program is compiled: of the split body and of the other one.
macro_rules! known_motion_kinds {
    ($($(#[$doc:meta])* $name:ident: $split:literal, $other:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $name;

        impl MotionKind for $name {
            const BOTH_MAY_TURN: bool = $split && $other;
            const MAY_ACCELERATE: bool = false;
            const STANDS_STILL: bool = false;

            #[inline(always)]
            fn does_split_body_turn(_: bool) -> bool {
                $split
            }

            #[inline(always)]
            fn does_other_body_turn(_: bool) -> bool {
                $other
            }
        }
    )*};
}

known_motion_kinds! {
    /// Neither body turns.
    Straight: false, false;
    /// Only the body turns whose node is split.
    SplitBodyTurns: true, false;
    /// Only the other body turns.
    OtherBodyTurns: false, true;
    /// Both bodies turn.
    BothTurn: true, true;
}

/// Defines kinds of motion of which only that is known when the program is compiled whether the bodies stand still.
macro_rules! open_motion_kinds {
    ($($(#[$doc:meta])* $name:ident: $still:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $name;

        impl MotionKind for $name {
            const BOTH_MAY_TURN: bool = true;
            const MAY_ACCELERATE: bool = true;
            const STANDS_STILL: bool = $still;

            #[inline(always)]
            fn does_split_body_turn(turns: bool) -> bool {
                turns
            }

            #[inline(always)]
            fn does_other_body_turn(turns: bool) -> bool {
                turns
            }
        }
    )*};
}

open_motion_kinds! {
    /// Any motion, also with accelerations.
    AnyMotion: false;
    /// The bodies stand still in the poses of an instant of any motion.
    StandStill: true;
}
