//! Eight pairs of nodes at once: how far apart they are, and until when that is certain.
//!
//! Everything here is relative to the origin of the group that is split, in its body's frame, in
//! f32, one array lane per child; loops over lanes are what the compiler turns into vector code.
//! The rounding of every gap and rate is covered by the slacks of [`RelativeMotionF32`].

use super::axis;
use super::eight_pairs::{EightPairs, RelativeMotionF32};
use super::shape::{Children, OtherNode};
use super::turn::Turn;
use super::vector_f32::max;
use crate::body::tree::LANES;
use crate::tolerance::{LOOK_AGAIN, SWEPT, THICKNESS};

/// The bounds of eight pairs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// For how long each pair is certainly farther apart than the gap that is to be kept.
    pub(crate) free: [f32; LANES],
    /// Positive when a pair is so far apart for its size that looking at it again, once its time is
    /// over, is worth more than splitting it.
    pub(crate) waits: [f32; LANES],
    /// The thickness of the child along the axis, less that of the other node.
    pub(crate) thicker: [f32; LANES],
    /// The gap that the free times prove to be kept.
    pub(crate) kept: f32,
}

/// Bounds eight pairs along planes that stand still.
///
/// Two axes are tried: the one with the widest gap now, and the one along which the centres are
/// apart when they are nearest. The first suits pairs that approach, the second pairs that pass.
#[inline(always)]
pub(crate) fn bound<C: Children, P: OtherNode, S: Turn, O: Turn>(
    children: &C,
    other: &P,
    motion: &RelativeMotionF32<S, O>,
) -> Bounds {
    let mut out = Bounds {
        free: [0.0; LANES],
        waits: [0.0; LANES],
        thicker: [0.0; LANES],
        kept: motion.kept,
    };
    let pairs = EightPairs::new(children, other, motion);
    for lane in 0..LANES {
        let pair = pairs.lane(lane);
        let widest = axis::widest(children, other, lane, pair.way);
        let passing = axis::passing(
            children,
            other,
            lane,
            pair.way,
            pair.velocity * motion.horizon,
        );
        out.free[lane] = max(pairs.free(&pair, widest), pairs.free(&pair, passing));
        let radius = children.radius(lane);
        out.waits[lane] = widest.gap - motion.slack - LOOK_AGAIN * (radius + other.radius());
        out.thicker[lane] = (widest.split_reach + THICKNESS * radius)
            - (widest.other_reach + THICKNESS * other.radius());
    }
    out
}

/// Bounds eight pairs along planes that turn with the body of the larger nodes, where those of
/// [`bound`] do not last as long.
#[inline(always)]
pub(crate) fn bound_attached<C: Children, P: OtherNode, S: Turn, O: Turn>(
    children: &C,
    other: &P,
    motion: &RelativeMotionF32<S, O>,
    larger: Larger,
    out: &mut Bounds,
) {
    let pairs = EightPairs::new(children, other, motion);
    for lane in 0..LANES {
        let pair = pairs.lane(lane);
        let widest = axis::widest(children, other, lane, pair.way);
        let past = match larger {
            Larger::Split => Past {
                attached: pairs.free_with_split(widest),
                spin: motion.split.rate(),
                arm: motion.split.arm(other.centre()),
                large: children.radius(lane),
                small: other.radius(),
                whole: children.is_piece(lane),
            },
            Larger::Other => Past {
                attached: pairs.free_with_other(&pair, widest),
                spin: motion.other.rate(),
                arm: motion.other.arm(children.centre(lane)),
                large: other.radius(),
                small: children.radius(lane),
                whole: other.is_piece(),
            },
        };
        let free = max(out.free[lane], past.attached);
        out.free[lane] = free;
        let swept = free * past.spin * past.arm - past.large * SWEPT;
        let clear = widest.gap - motion.slack - LOOK_AGAIN * past.small;
        let waits = if past.whole { max(swept, clear) } else { swept };
        out.waits[lane] = max(out.waits[lane], waits);
    }
}

/// A small node past a much larger one that turns.
struct Past {
    /// For how long a plane that turns with the large one keeps it apart.
    attached: f32,
    /// The rate at which the large one turns, and the distance of the small one from its body's
    /// centre.
    spin: f32,
    arm: f32,
    /// The radii.
    large: f32,
    small: f32,
    /// The large one cannot be split, so that only the small one's size decides whether it is far.
    whole: bool,
}

/// The side whose nodes are much larger than the other's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Larger {
    Split,
    Other,
}

#[cfg(test)]
mod tests;
