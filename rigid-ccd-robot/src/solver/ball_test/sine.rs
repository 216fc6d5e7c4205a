//! Sine and cosine of eight angles in f32.

use ccd_core::fearless_simd::{Simd, f32x8, prelude::*, u32x8};
use ccd_core::simd::splat;

/// The largest absolute value of an angle for which [`sin_cos`] is accurate.
pub(super) const MAX_ANGLE: f64 = 100.0;

/// The sum `x + ROUNDING_TERM` is rounded to an integer, whose lowest bits are the lowest bits of the sum.
const ROUNDING_TERM: f32 = 12_582_912.0;

/// A quarter turn as a sum of three numbers. The products of the first two with an integer up to 64 are exact.
const QUARTER_TURN: [f32; 3] = [1.570_312_5, 4.837_513e-4, 7.549_79e-8];

/// Returns the sines and the cosines of angles in radians.
///
/// # Guarantee
/// For angles within ±[`MAX_ANGLE`], the error is at most 8 units of roundoff, `8 · 2⁻²⁴`.
#[inline(always)]
pub(super) fn sin_cos<L: Simd>(level: L, angle: f32x8<L>) -> [f32x8<L>; 2] {
    let number = |x: f32| splat(level, x);
    let shifted = angle * number(std::f32::consts::FRAC_2_PI) + number(ROUNDING_TERM);
    let turns = shifted - number(ROUNDING_TERM);
    let x = angle - turns * number(QUARTER_TURN[0]);
    let x = x - turns * number(QUARTER_TURN[1]);
    let x = x - turns * number(QUARTER_TURN[2]);
    let square = x * x;
    let tail = number(-1.951_529_6e-4) * square + number(8.332_161e-3);
    let tail = tail * square + number(-1.666_665_5e-1);
    let sine = x + x * (square * tail);
    let tail = number(2.443_315_7e-5) * square + number(-1.388_731_6e-3);
    let tail = tail * square + number(4.166_664_6e-2);
    let cosine = number(1.0) + square * (number(-0.5) + square * tail);
    // The number of quarter turns, modulo 4.
    let quarter: u32x8<L> = shifted.bitcast();
    let bits = |x: u32| u32x8::splat(level, x);
    let is_odd = (quarter & bits(1)).simd_eq(bits(1));
    let sine_sign = (quarter & bits(2)) << 30;
    let cosine_sign = ((quarter + bits(1)) & bits(2)) << 30;
    let swapped: [u32x8<L>; 2] = [
        is_odd.select(cosine, sine).bitcast(),
        is_odd.select(sine, cosine).bitcast(),
    ];
    [
        (swapped[0] ^ sine_sign).bitcast(),
        (swapped[1] ^ cosine_sign).bitcast(),
    ]
}

#[cfg(test)]
mod tests;
