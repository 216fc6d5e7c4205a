//! The free times of eight pairs, the times for which they stay apart, packed for the queue.

use crate::body::tree::LANES;
use crate::math::order::lesser;
use crate::math::simd::splat;
use fearless_simd::{ExtractToken, Simd, SimdSplit, f32x8, mask32x8, prelude::*, u32x8};

/// The free times of eight pairs, the times for which they stay apart, as bits of f32. The lowest bits of each hold the
/// pair's lane, and the time is rounded down to make room, so that the least value also names its lane. Bits of
/// non-negative numbers have the order of the numbers. Comparing them as integers also distinguishes numbers next to
/// zero if the processor is set to flush those to zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FreeTimes {
    bits: [u32; LANES],
    /// The least of `bits`. Every visit reads it several times.
    least: u32,
}

const LANE_INDEX_MASK: u32 = LANES as u32 - 1;

/// The value of a finished pair, greater than all others.
const FINISHED_BITS: u32 = f32::INFINITY.to_bits() | LANE_INDEX_MASK;

impl FreeTimes {
    /// Creates the times of up to eight pairs, one for each lane. Lanes that are not in `used` count as finished.
    #[inline(always)]
    pub(crate) fn pack<L: Simd>(free: f32x8<L>, used: u8) -> Self {
        let level = free.token();
        let lanes: u32x8<L> = [0, 1, 2, 3, 4, 5, 6, 7].simd_into(level);
        // Written so that NaN counts as zero, and negative zero as zero.
        let free = free.simd_gt(0.0).select(free, splat(level, 0.0));
        let used = mask32x8::from_bitmask(level, used.into());
        let free: u32x8<L> = used.select(free, splat(level, f32::INFINITY)).bitcast();
        let bits = free & !LANE_INDEX_MASK | lanes;
        let (low, high) = bits.split();
        let [a, b, c, d] = *low.min(high);
        FreeTimes {
            bits: *bits,
            least: lesser(lesser(a, b), lesser(c, d)),
        }
    }

    /// Creates the times of a single pair in this lane, with a free time of 0.
    pub(crate) fn single_in_lane(lane: usize) -> Self {
        let mut bits = [FINISHED_BITS; LANES];
        bits[lane] = lane as u32;
        FreeTimes {
            bits,
            least: lane as u32,
        }
    }

    /// Returns the least free time; infinity if all pairs are finished.
    #[inline]
    pub(crate) fn least_time(&self) -> f32 {
        unpack_time(self.least)
    }

    /// Returns the lane with the least free time.
    #[inline]
    pub(crate) fn least_lane(&self) -> usize {
        (self.least & LANE_INDEX_MASK) as usize
    }

    /// Marks the pair with the least free time as finished, and returns its lane.
    #[inline]
    pub(crate) fn finish_least_lane(&mut self) -> usize {
        let lane = self.least_lane();
        self.finish_lane(lane);
        lane
    }

    /// Marks the pair in a lane as finished.
    #[inline]
    pub(crate) fn finish_lane(&mut self, lane: usize) {
        self.bits[lane] = FINISHED_BITS;
        let [a, b, c, d, e, f, g, h] = self.bits;
        let [a, b, c, d] = [lesser(a, e), lesser(b, f), lesser(c, g), lesser(d, h)];
        self.least = lesser(lesser(a, c), lesser(b, d));
    }

    /// Returns the free time of a lane.
    pub(crate) fn time_of_lane(&self, lane: usize) -> f32 {
        unpack_time(self.bits[lane])
    }
}

/// Returns the free time in a packed value, without the bits of its lane.
#[inline]
fn unpack_time(bits: u32) -> f32 {
    f32::from_bits(bits & !LANE_INDEX_MASK)
}

#[cfg(test)]
mod tests;
