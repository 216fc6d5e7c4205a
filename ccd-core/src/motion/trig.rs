//! Sine and cosine with the same bits on every machine.

use std::f64::consts::FRAC_2_PI;

/// π/2 as a sum of three numbers; products of the first two with an integer below 2²⁰ are exact.
const HALF_PI: [f64; 3] = [
    f64::from_bits(0x3ff9_21fb_5440_0000),
    f64::from_bits(0x3dd0_b461_1a60_0000),
    f64::from_bits(0x3ba3_198a_2e03_7073),
];

/// Taylor coefficients of `(sin r − r)/r³` and of `(cos r − 1 + r²/2)/r⁴` in r². On |r| ≤ π/4 the
/// first omitted terms are below 2⁻⁵⁶.
const SINE: [f64; 7] = [
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5_040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
];
const COSINE: [f64; 7] = [
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
];

/// Returns the sine and cosine of an angle from 0 up to [`MAX_TURN`](crate::limits::MAX_TURN).
///
/// # Guarantee
/// Each is off by at most 2u, as [`distance_rounding`](crate::rounding::distance_rounding) counts.
#[inline(always)]
pub(crate) fn sin_cos(angle: f64) -> (f64, f64) {
    // Angles are not negative: truncation rounds down, and needs no library call.
    let turns = (angle * FRAC_2_PI + 0.5) as i32;
    let quarter = f64::from(turns);
    // The first difference is exact, and the sum off by 2⁻⁶⁷ at most; the last step adds a relative 2⁻⁵³.
    let r = (angle - quarter * HALF_PI[0]) - (quarter * HALF_PI[1] + quarter * HALF_PI[2]);
    let square = r * r;
    let fourth = square * square;
    // The sum has few dependent steps, since a visit waits for its result.
    let sum = |&[a, b, c, d, e, f, g]: &[f64; 7]| {
        let low = (a + b * square) + (c + d * square) * fourth;
        low + ((e + f * square) + g * fourth) * (fourth * fourth)
    };
    let sine = r + r * square * sum(&SINE);
    let cosine = 1.0 - (0.5 * square - fourth * sum(&COSINE));
    match turns & 3 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

#[cfg(test)]
mod tests;
