//! Double-double arithmetic: numbers with twice the digits `[SHE97]`.
//!
//! A small difference of large numbers has no correct digit in f64. Sums of pairs of f64 have 106 bits: a sum or a product is off
//! by at most 2⁻¹⁰² of the sum of the terms' magnitudes.

use std::ops::{Add, Mul, Sub};

/// A number with twice the digits of f64, as the unevaluated sum of two f64.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// Returns `a − b` without rounding.
    #[inline]
    pub fn difference(a: f64, b: f64) -> Self {
        let high = a - b;
        let back = high - a;
        let low = (a - (high - back)) - (b + back);
        DoubleDouble { high, low }
    }

    /// Returns `a · b` without rounding, unless it underflows.
    #[inline]
    pub fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        DoubleDouble {
            high,
            low: a.mul_add(b, -high),
        }
    }

    /// Returns the number with the given [parts](Self::parts).
    #[inline]
    pub fn from_parts([high, low]: [f64; 2]) -> Self {
        DoubleDouble { high, low }
    }

    /// Returns the two f64 of which the number is the sum.
    #[inline]
    pub fn parts(self) -> [f64; 2] {
        [self.high, self.low]
    }

    /// Rounds the number to f64.
    #[inline]
    pub fn value(self) -> f64 {
        self.high + self.low
    }

    /// Returns the exact sum of two numbers as a double-double; the magnitude of the first must be at least that of the
    /// second.
    #[inline]
    fn fast_two_sum(high: f64, low: f64) -> Self {
        let sum = high + low;
        DoubleDouble {
            high: sum,
            low: low - (sum - high),
        }
    }
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(high: f64) -> Self {
        DoubleDouble { high, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = DoubleDouble;

    #[inline]
    fn add(self, other: DoubleDouble) -> DoubleDouble {
        let sum = DoubleDouble::difference(self.high, -other.high);
        DoubleDouble::fast_two_sum(sum.high, sum.low + (self.low + other.low))
    }
}

impl Sub for DoubleDouble {
    type Output = DoubleDouble;

    #[inline]
    fn sub(self, other: DoubleDouble) -> DoubleDouble {
        let negated = DoubleDouble {
            high: -other.high,
            low: -other.low,
        };
        self + negated
    }
}

impl Mul for DoubleDouble {
    type Output = DoubleDouble;

    #[inline]
    fn mul(self, other: DoubleDouble) -> DoubleDouble {
        let DoubleDouble { high, low } = DoubleDouble::product(self.high, other.high);
        DoubleDouble::fast_two_sum(high, low + (self.high * other.low + self.low * other.high))
    }
}

#[cfg(test)]
mod tests;
