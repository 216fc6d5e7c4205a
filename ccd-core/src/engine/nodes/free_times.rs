//! The free times of eight pairs in a compact form, from which the least is removed repeatedly.

use crate::body::tree::LANES;
use crate::math::lanes::splat;
use crate::math::order::lesser;
use fearless_simd::{ExtractToken, Simd, f32x8, mask32x8, prelude::*, u32x8};

/// The free times of eight pairs, as bits of f32. The lowest bits of each hold the pair's lane, and the time is rounded
/// down to make room, so that the least value also names its lane. Bits of non-negative numbers have the order of the
/// numbers. Comparing them as integers also distinguishes numbers next to zero if the processor is set to flush those
/// to zero.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct FreeTimes([u32; LANES]);

const LANE_BITS: u32 = LANES as u32 - 1;

/// The value of a finished pair, greater than all others.
const FINISHED: u32 = f32::INFINITY.to_bits() | LANE_BITS;

impl FreeTimes {
    /// Creates the times of a single pair, in the first lane, with a free time of 0.
    pub(crate) fn first_lane() -> Self {
        FreeTimes::of_lane(0)
    }

    /// Packs the times of the lanes in `used`; the others count as finished.
    #[inline(always)]
    pub(crate) fn pack<L: Simd>(free: f32x8<L>, used: u8) -> Self {
        let level = free.token();
        let lanes: u32x8<L> = [0, 1, 2, 3, 4, 5, 6, 7].simd_into(level);
        // Written so that NaN counts as zero, and negative zero as zero.
        let free = free.simd_gt(0.0).select(free, splat(level, 0.0));
        let used = mask32x8::from_bitmask(level, used.into());
        let free: u32x8<L> = used.select(free, splat(level, f32::INFINITY)).bitcast();
        FreeTimes(*(free & !LANE_BITS | lanes))
    }

    /// Returns the least free time; infinity if all pairs are finished.
    #[inline]
    pub(crate) fn least(&self) -> f32 {
        time(self.least_bits())
    }

    /// Creates the times of a single pair in this lane, with a free time of 0.
    pub(crate) fn of_lane(lane: usize) -> Self {
        let mut times = [FINISHED; LANES];
        times[lane] = lane as u32;
        FreeTimes(times)
    }

    /// Returns the lane with the least free time.
    #[inline]
    pub(crate) fn least_lane(&self) -> usize {
        (self.least_bits() & LANE_BITS) as usize
    }

    /// Marks the pair with the least free time as finished, and returns its lane.
    #[inline]
    pub(crate) fn take_least(&mut self) -> usize {
        let least = self.least_bits();
        // All lanes are written at once, so that the next read need not wait for a single store.
        for bits in &mut self.0 {
            *bits = if *bits == least { FINISHED } else { *bits };
        }
        (least & LANE_BITS) as usize
    }

    /// Returns the least of the eight values, by halving the lanes until one is left.
    #[inline]
    fn least_bits(&self) -> u32 {
        let [a, b, c, d, e, f, g, h] = self.0;
        let [a, b, c, d] = [lesser(a, e), lesser(b, f), lesser(c, g), lesser(d, h)];
        lesser(lesser(a, c), lesser(b, d))
    }

    /// Marks the pair in a lane as finished.
    pub(crate) fn finish(&mut self, lane: usize) {
        self.0[lane] = FINISHED;
    }

    /// Returns the free time of a lane.
    pub(crate) fn time_of_lane(&self, lane: usize) -> f32 {
        time(self.0[lane])
    }
}

/// Clears the bits of the lane, and returns the time.
#[inline]
fn time(bits: u32) -> f32 {
    f32::from_bits(bits & !LANE_BITS)
}

#[cfg(test)]
mod tests;
