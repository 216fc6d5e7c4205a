//! Bounds eight pairs of nodes at once: their distances, and the times for which they stay apart.
//!
//! Everything here is relative to the origin of the split group, in its body's frame, in f32, with
//! one array lane per child. The compiler vectorises loops over lanes. The slacks of
//! [`RelativeMotionF32`] cover the rounding of every gap and rate.

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
    /// The time for which each pair certainly stays farther apart than the gap to be kept.
    pub(crate) free: [f32; LANES],
    /// Positive when a pair is so far apart for its size that a second look after its time is worth
    /// more than a split.
    pub(crate) waits: [f32; LANES],
    /// The thickness of the child along the axis, less that of the other node.
    pub(crate) thicker: [f32; LANES],
    /// The gap that the pairs keep for their free times.
    pub(crate) kept: f32,
}

/// Bounds eight pairs along fixed planes.
///
/// It tries two axes: the one with the widest gap now, and the one between the centres when they
/// are nearest. The first suits approaching pairs, the second passing ones.
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

/// Bounds eight pairs along planes that turn with the body of the larger nodes. Each pair keeps the
/// later of this time and that of [`bound`].
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

/// A small node that passes a much larger, turning one.
struct Past {
    /// The time for which a plane that turns with the large node keeps the pair apart.
    attached: f32,
    /// The rate at which the large node turns, and the distance of the small one from its body's
    /// centre.
    spin: f32,
    arm: f32,
    /// The radii.
    large: f32,
    small: f32,
    /// True if the large node cannot be split: then only the small one's size decides whether it is
    /// far.
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
