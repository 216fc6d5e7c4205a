//! Bounds eight pairs of nodes at once: for how long they stay apart, and whether to split them.
//!
//! All vectors here are relative to the origin of the split group, in its body's frame, in f32, with one lane per
//! child. The slacks of [`RelativeMotionF32`] cover the rounding of every gap and rate.

use super::axis::{AxesX8, closest_approach_axis, slowest_closing_axis};
use super::eight_pairs::{EightPairs, LargerBody, RelativeMotionF32};
use super::free_times::FreeTimes;
use super::shape::{Children, OtherNode};
use crate::math::simd::splat;
use crate::tuning::{ADDED_THICKNESS_PER_RADIUS, MIN_REVISIT_DISTANCE_RATIO, MIN_REVISIT_SWEEP};
use fearless_simd::{Simd, f32x8, mask32x8, prelude::*};

/// The free times of eight pairs of nodes, and the choices for the next step of each pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EightPairFreeTimes {
    /// The time for which each pair certainly stays farther apart than the required gap.
    pub(crate) free_times: FreeTimes,
    /// The pairs to visit again instead of splitting them, as bits. They are far apart for their size.
    pub(crate) revisit_mask: u8,
    /// The pairs whose child is to be split rather than the other node, as bits. Such a child is thicker along the
    /// axis.
    pub(crate) split_child_mask: u8,
    /// True if the other node is a single piece, and cannot be split.
    pub(crate) other_is_piece: bool,
}

/// Computes the free times of the pairs in `lanes`, and chooses the next step for each pair.
///
/// Fixed planes are perpendicular to two axes: the one of three along which the gap takes longest to close, and the one
/// between the centers at the time when they are nearest. The first suits approaching pairs, the second passing ones.
/// Beside nodes that are much larger, planes that turn with the body of these nodes are tried, too.
#[cfg_attr(inline_kernels, inline(always))]
pub(crate) fn bound_eight_pairs<L: Simd, C: Children, P: OtherNode>(
    level: L,
    children: &C,
    other: &P,
    motion: &RelativeMotionF32,
    lanes: u8,
) -> EightPairFreeTimes {
    let pairs = EightPairs::new(level, children, other, motion);
    let passing = closest_approach_axis(
        children,
        other,
        pairs.offset,
        pairs.velocity,
        motion.remaining_time,
    );
    let passing_time = pairs.fixed_plane_free_times(passing);
    let slowest = slowest_closing_axis(
        children,
        other,
        pairs.offset,
        pairs.velocity,
        motion.required_gap,
    );
    let radius = children.radius(level);
    let revisit = slowest.across.gap
        - motion.required_gap
        - (radius + other.radius()) * MIN_REVISIT_DISTANCE_RATIO;
    let split_child = (slowest.across.child_extent + radius * ADDED_THICKNESS_PER_RADIUS)
        - (slowest.across.other_extent + ADDED_THICKNESS_PER_RADIUS * other.radius());
    let mut free = pairs.fixed_plane_free_times(slowest).max(passing_time);
    let mut revisit = mask_bits(revisit.simd_gt(0.0));
    if let Some(past) = FlybyPairs::new(&pairs, slowest) {
        free = free.max(past.turning_plane_time);
        revisit |= mask_bits(past.revisit_mask(free, slowest.across.gap - motion.required_gap));
    }
    let split_child = if other.is_piece() {
        u8::MAX
    } else {
        mask_bits(split_child.simd_gt(0.0))
    };
    EightPairFreeTimes {
        free_times: FreeTimes::pack(free, lanes),
        revisit_mask: revisit,
        split_child_mask: split_child & !mask_bits(children.leaf_children_mask(level)),
        other_is_piece: other.is_piece(),
    }
}

#[inline(always)]
fn mask_bits<L: Simd>(mask: mask32x8<L>) -> u8 {
    mask.to_bitmask() as u8
}

/// The values of eight pairs, in each of which a small node passes a much larger node of a turning body.
struct FlybyPairs<L: Simd> {
    /// The time for which a plane that turns with the large node's body keeps the pair apart.
    turning_plane_time: f32x8<L>,
    /// The angular speed of the large node's body.
    spin: f32,
    small_node_arm_length: f32x8<L>,
    /// The radius of the large node.
    large_radius: f32x8<L>,
    small_radius: f32x8<L>,
    /// Set if the large node is a single piece. Then only the size of the small node decides whether the pair is far
    /// apart.
    large_node_is_piece: mask32x8<L>,
}

impl<L: Simd> FlybyPairs<L> {
    /// Computes the values of eight pairs of a small and a large turning node; `None` if no body turns whose nodes are
    /// much larger than the other's.
    #[inline(always)]
    fn new<C: Children, P: OtherNode>(
        pairs: &EightPairs<'_, L, C, P>,
        axis: AxesX8<L>,
    ) -> Option<Self> {
        let EightPairs {
            children,
            other_node: other,
            motion,
            ..
        } = *pairs;
        let level = pairs.simd_level();
        match motion.larger_body? {
            LargerBody::BodyToSplit => Some(FlybyPairs {
                turning_plane_time: pairs.free_times_turning_with_split_body(axis),
                spin: motion.split_body_rotation.angular_speed,
                small_node_arm_length: splat(
                    level,
                    motion
                        .split_body_rotation
                        .distance_from_center(other.center()),
                ),
                large_radius: children.radius(level),
                small_radius: splat(level, other.radius()),
                large_node_is_piece: children.leaf_children_mask(level),
            }),
            LargerBody::OtherBody => Some(FlybyPairs {
                turning_plane_time: pairs.free_times_of_planes_turning_with_other(axis),
                spin: motion.other_rotation.angular_speed,
                small_node_arm_length: motion
                    .other_rotation
                    .distances_from_center(children.center(level)),
                large_radius: splat(level, other.radius()),
                small_radius: children.radius(level),
                large_node_is_piece: mask32x8::splat(level, other.is_piece()),
            }),
        }
    }

    /// Returns the pairs for which a second visit is worth more than a split.
    #[inline(always)]
    fn revisit_mask(&self, free: f32x8<L>, apart: f32x8<L>) -> mask32x8<L> {
        let swept =
            free * self.spin * self.small_node_arm_length - self.large_radius * MIN_REVISIT_SWEEP;
        let clear = apart - self.small_radius * MIN_REVISIT_DISTANCE_RATIO;
        swept.simd_gt(0.0) | self.large_node_is_piece & clear.simd_gt(0.0)
    }
}

#[cfg(test)]
mod tests;
