//! Computes lower bounds of the times for which gaps stay open, in f32.

use crate::math::simd::splat;
use crate::rounding::{FREE_TIME_FACTOR_F32, LEAST_SECOND_DERIVATIVE_F32, UNIT_ROUNDOFF_F32};
use fearless_simd::{ExtractToken, Simd, f32x8, prelude::*};

/// Returns the largest τ with `apart ≥ rate τ + second_derivative τ²/2`. It is 0 for NaN, and for a pair that is apart
/// by at most `closed`, even if it recedes.
#[cfg_attr(inline_kernels, inline(always))]
pub(crate) fn free_time<L: Simd>(
    apart: f32x8<L>,
    closed: f32,
    rate: f32x8<L>,
    second_derivative: f32x8<L>,
) -> f32x8<L> {
    let root = (rate * rate + second_derivative * 2.0 * apart).sqrt();
    // Two forms of the same solution, of which each cancels where the other one does not.
    let approaches = rate.simd_gt(0.0);
    let numerator = approaches.select(apart * 2.0, root - rate);
    let divisor = approaches.select(rate + root, second_derivative);
    let tau = numerator * FREE_TIME_FACTOR_F32 / divisor;
    // An overflowed root proves nothing.
    let proven = apart.simd_gt(closed) & tau.simd_gt(0.0) & root.simd_le(f32::MAX);
    proven.select(tau, splat(apart.token(), 0.0))
}

/// Like `free_time`, for a `second_derivative` that may be negative: a gap that closes ever slower may never
/// close.
#[cfg_attr(inline_kernels, inline(always))]
pub(crate) fn free_time_decelerating<L: Simd>(
    apart: f32x8<L>,
    closed: f32,
    rate: f32x8<L>,
    second_derivative: f32x8<L>,
) -> f32x8<L> {
    let level = apart.token();
    let accelerating = free_time(
        apart,
        closed,
        rate,
        second_derivative.max(LEAST_SECOND_DERIVATIVE_F32),
    );
    let (square, lost) = (rate * rate, second_derivative * -2.0 * apart);
    // A sum that is lost to rounding or to underflow counts as zero.
    let left = (square - lost) + (square + lost) * (16.0 * UNIT_ROUNDOFF_F32) + f32::MIN_POSITIVE;
    let meets = rate.simd_gt(0.0) & left.simd_ge(0.0);
    let closing = apart * (2.0 * FREE_TIME_FACTOR_F32) / (rate + left.sqrt());
    let parts = meets.select(closing, splat(level, f32::INFINITY));
    // Written so that neither NaN nor an overflow proves anything.
    let known = square.simd_le(f32::MAX) & lost.simd_le(f32::MAX);
    let proven = apart.simd_gt(closed) & known & rate.simd_le(f32::MAX);
    let parts = proven.select(parts, splat(level, 0.0));
    second_derivative.simd_lt(0.0).select(parts, accelerating)
}

/// Like `free_time`, with a second derivative of 0.
#[inline(always)]
pub(crate) fn free_time_at_constant_rate<L: Simd>(
    apart: f32x8<L>,
    closed: f32,
    rate: f32x8<L>,
) -> f32x8<L> {
    let level = apart.token();
    // Written so that NaN proves nothing.
    let tau = rate
        .simd_le(0.0)
        .select(splat(level, f32::INFINITY), apart / rate);
    let proven = apart.simd_gt(closed) & tau.simd_gt(0.0);
    proven.select(tau * FREE_TIME_FACTOR_F32, splat(level, 0.0))
}
