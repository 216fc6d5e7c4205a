//! Bounds eight pairs of nodes at once: for how long they stay apart, and whether to split them.
//!
//! All vectors here are relative to the origin of the split group, in its body's frame, in f32, with one lane per
//! child. The slacks of [`RelativeMotionF32`] cover the rounding of every gap and rate.

use super::axis::{self, Axis};
use super::eight_pairs::{EightPairs, Larger, RelativeMotionF32};
use super::free_times::FreeTimes;
use super::shape::{Children, OtherNode};
use crate::math::lanes::splat;
use crate::tuning::{ADDED_THICKNESS, MIN_SWEEP, REVISIT_DISTANCE};
use fearless_simd::{Simd, f32x8, mask32x8, prelude::*};

/// The bounds of eight pairs, and hints for the next step of each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// The time for which each pair is certainly farther apart than the required gap.
    pub(crate) free: FreeTimes,
    /// The pairs that are far apart for their size, as bits. A second visit after their time is worth more than a
    /// split.
    pub(crate) revisit: u8,
    /// The pairs whose child should be split rather than the other node, as bits: it is thicker along the axis.
    pub(crate) split_child: u8,
    /// True if the other node is a single piece, and cannot be split.
    pub(crate) other_is_piece: bool,
}

/// Bounds the pairs in `lanes`, and decides what to do with each next.
///
/// Fixed planes are perpendicular to two axes: the one with the widest gap now, and the one between the centres at
/// the time when they are nearest. The first suits approaching pairs, the second passing ones. Beside nodes that are
/// much larger, planes that turn with the body of these nodes are tried, too.
#[inline(always)]
pub(crate) fn bound<L: Simd, C: Children, P: OtherNode>(
    level: L,
    children: &C,
    other: &P,
    motion: &RelativeMotionF32,
    lanes: u8,
) -> Bounds {
    let pairs = EightPairs::new(level, children, other, motion);
    let widest = axis::widest_axis(children, other, pairs.offset);
    let travel = pairs.velocity * splat(level, motion.horizon);
    let passing = axis::closest_approach_axis(children, other, pairs.offset, travel);
    let radius = children.radius(level);
    let revisit = widest.gap - motion.slack - (radius + other.radius()) * REVISIT_DISTANCE;
    let split_child = (widest.split_reach + radius * ADDED_THICKNESS)
        - (widest.other_reach + ADDED_THICKNESS * other.radius());
    let mut free = pairs.free(widest).max(pairs.free(passing));
    let mut revisit = bits(revisit.simd_gt(0.0));
    if let Some(past) = PassingNode::new(&pairs, widest) {
        free = free.max(past.turning_plane_time);
        revisit |= bits(past.revisit(free, widest.gap - motion.slack));
    }
    let split_child = if other.is_piece() {
        u8::MAX
    } else {
        bits(split_child.simd_gt(0.0))
    };
    Bounds {
        free: FreeTimes::pack(free, lanes),
        revisit,
        split_child: split_child & !bits(children.pieces(level)),
        other_is_piece: other.is_piece(),
    }
}

#[inline(always)]
fn bits<L: Simd>(mask: mask32x8<L>) -> u8 {
    mask.to_bitmask() as u8
}

/// A small node that passes a much larger node of a turning body.
struct PassingNode<L: Simd> {
    /// The time for which a plane that turns with the large node's body keeps the pair apart.
    turning_plane_time: f32x8<L>,
    /// The angular speed of the large node's body.
    spin: f32,
    arm: f32x8<L>,
    /// The radius of the large node.
    large: f32x8<L>,
    small: f32x8<L>,
    /// Set if the large node is a single piece. Then only the size of the small node decides whether it is far.
    other_is_piece: mask32x8<L>,
}

impl<L: Simd> PassingNode<L> {
    /// Creates the value; `None` if no body turns whose nodes are much larger.
    #[inline(always)]
    fn new<C: Children, P: OtherNode>(
        pairs: &EightPairs<'_, L, C, P>,
        axis: Axis<L>,
    ) -> Option<Self> {
        let EightPairs {
            children,
            other,
            motion,
            ..
        } = *pairs;
        let level = pairs.level();
        match motion.larger? {
            Larger::Split => Some(PassingNode {
                turning_plane_time: pairs.free_with_split(axis),
                spin: motion.split.rate,
                arm: splat(level, motion.split.distance_from_centre(other.centre())),
                large: children.radius(level),
                small: splat(level, other.radius()),
                other_is_piece: children.pieces(level),
            }),
            Larger::Other => Some(PassingNode {
                turning_plane_time: pairs.free_with_other(axis),
                spin: motion.other.rate,
                arm: motion.other.distances_from_centre(children.centre(level)),
                large: splat(level, other.radius()),
                small: children.radius(level),
                other_is_piece: mask32x8::splat(level, other.is_piece()),
            }),
        }
    }

    /// Returns the pairs for which a second visit is worth more than a split.
    #[inline(always)]
    fn revisit(&self, free: f32x8<L>, apart: f32x8<L>) -> mask32x8<L> {
        let swept = free * self.spin * self.arm - self.large * MIN_SWEEP;
        let clear = apart - self.small * REVISIT_DISTANCE;
        swept.simd_gt(0.0) | self.other_is_piece & clear.simd_gt(0.0)
    }
}

#[cfg(test)]
mod tests;
