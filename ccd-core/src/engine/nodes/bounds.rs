//! Bounds eight pairs of nodes at once: for how long they stay apart, and whether to split them.
//!
//! All vectors here are relative to the origin of the split group, in its body's frame, in f32, with one lane per
//! child. The slacks of [`RelativeMotionF32`] cover the rounding of every gap and rate.

use super::axis::{self, AxesX8};
use super::eight_pairs::{EightPairs, LargerBody, RelativeMotionF32};
use super::shape::{Children, OtherNode};
use crate::body::tree::LANES;
use crate::math::order::lesser;
use crate::math::simd::splat;
use crate::tuning::{ADDED_THICKNESS_PER_RADIUS, MIN_REVISIT_DISTANCE_RATIO, MIN_REVISIT_SWEEP};
use fearless_simd::{ExtractToken, Simd, f32x8, mask32x8, prelude::*, u32x8};

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
/// Fixed planes are perpendicular to two axes: the one with the widest gap now, and the one between the centres at
/// the time when they are nearest. The first suits approaching pairs, the second passing ones. Beside nodes that are
/// much larger, planes that turn with the body of these nodes are tried, too.
#[inline(always)]
pub(crate) fn bound_eight_pairs<L: Simd, C: Children, P: OtherNode>(
    level: L,
    children: &C,
    other: &P,
    motion: &RelativeMotionF32,
    lanes: u8,
) -> EightPairFreeTimes {
    let pairs = EightPairs::new(level, children, other, motion);
    let widest = axis::widest_gap_axis(children, other, pairs.offset);
    let travel = pairs.velocity * splat(level, motion.remaining_time);
    let passing = axis::closest_approach_axis(children, other, pairs.offset, travel);
    let radius = children.radius(level);
    let revisit =
        widest.gap - motion.required_gap - (radius + other.radius()) * MIN_REVISIT_DISTANCE_RATIO;
    let split_child = (widest.child_extent + radius * ADDED_THICKNESS_PER_RADIUS)
        - (widest.other_extent + ADDED_THICKNESS_PER_RADIUS * other.radius());
    let mut free = pairs
        .fixed_plane_free_times(widest)
        .max(pairs.fixed_plane_free_times(passing));
    let mut revisit = mask_bits(revisit.simd_gt(0.0));
    if let Some(past) = FlybyPairs::new(&pairs, widest) {
        free = free.max(past.turning_plane_time);
        revisit |= mask_bits(past.revisit_mask(free, widest.gap - motion.required_gap));
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
                        .distance_from_centre(other.centre()),
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
                    .distances_from_centre(children.centre(level)),
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

/// The free times of eight pairs, the times for which they stay apart, as bits of f32. The lowest bits of each hold the
/// pair's lane, and the time is rounded down to make room, so that the least value also names its lane. Bits of
/// non-negative numbers have the order of the numbers. Comparing them as integers also distinguishes numbers next to
/// zero if the processor is set to flush those to zero.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct FreeTimes([u32; LANES]);

const LANE_INDEX_MASK: u32 = LANES as u32 - 1;

/// The value of a finished pair, greater than all others.
const FINISHED_BITS: u32 = f32::INFINITY.to_bits() | LANE_INDEX_MASK;

impl FreeTimes {
    /// Creates the times of a single pair, in the first lane, with a free time of 0.
    pub(crate) fn single_in_first_lane() -> Self {
        FreeTimes::single_in_lane(0)
    }

    /// Creates the times of up to eight pairs, one for each lane. Lanes that are not in `used` count as finished.
    #[inline(always)]
    pub(crate) fn pack<L: Simd>(free: f32x8<L>, used: u8) -> Self {
        let level = free.token();
        let lanes: u32x8<L> = [0, 1, 2, 3, 4, 5, 6, 7].simd_into(level);
        // Written so that NaN counts as zero, and negative zero as zero.
        let free = free.simd_gt(0.0).select(free, splat(level, 0.0));
        let used = mask32x8::from_bitmask(level, used.into());
        let free: u32x8<L> = used.select(free, splat(level, f32::INFINITY)).bitcast();
        FreeTimes(*(free & !LANE_INDEX_MASK | lanes))
    }

    /// Returns the least free time; infinity if all pairs are finished.
    #[inline]
    pub(crate) fn least_time(&self) -> f32 {
        unpack_time(self.least_bits())
    }

    /// Creates the times of a single pair in this lane, with a free time of 0.
    pub(crate) fn single_in_lane(lane: usize) -> Self {
        let mut times = [FINISHED_BITS; LANES];
        times[lane] = lane as u32;
        FreeTimes(times)
    }

    /// Returns the lane with the least free time.
    #[inline]
    pub(crate) fn least_lane(&self) -> usize {
        (self.least_bits() & LANE_INDEX_MASK) as usize
    }

    /// Marks the pair with the least free time as finished, and returns its lane.
    #[inline]
    pub(crate) fn finish_least_lane(&mut self) -> usize {
        let least = self.least_bits();
        // All lanes are written at once, so that the next read need not wait for a single store.
        for bits in &mut self.0 {
            *bits = if *bits == least { FINISHED_BITS } else { *bits };
        }
        (least & LANE_INDEX_MASK) as usize
    }

    /// Returns the least of the eight values, by halving the lanes until one is left.
    #[inline]
    fn least_bits(&self) -> u32 {
        let [a, b, c, d, e, f, g, h] = self.0;
        let [a, b, c, d] = [lesser(a, e), lesser(b, f), lesser(c, g), lesser(d, h)];
        lesser(lesser(a, c), lesser(b, d))
    }

    /// Marks the pair in a lane as finished.
    pub(crate) fn finish_lane(&mut self, lane: usize) {
        self.0[lane] = FINISHED_BITS;
    }

    /// Returns the free time of a lane.
    pub(crate) fn time_of_lane(&self, lane: usize) -> f32 {
        unpack_time(self.0[lane])
    }
}

/// Returns the free time in a packed value, without the bits of its lane.
#[inline]
fn unpack_time(bits: u32) -> f32 {
    f32::from_bits(bits & !LANE_INDEX_MASK)
}

#[cfg(test)]
mod tests;
