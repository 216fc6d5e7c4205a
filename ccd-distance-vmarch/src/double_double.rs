//! Double-double arithmetic: numbers with twice the digits `[SHE97]`.
//!
//! The normal of a sliver is the small difference of large products. In f64 it would have no
//! correct digit if the sliver is thinner than 1e-16 of its length, and lose accuracy in proportion
//! to its thinness otherwise. Sums of pairs of f64 have 106 bits.

use ccd_core::glam::DVec3;
use std::ops::{Add, Mul, Sub};

/// A number with twice the digits of f64, as the unevaluated sum of two f64.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// Returns `a − b` without rounding.
    pub(crate) fn difference(a: f64, b: f64) -> Self {
        let high = a - b;
        let back = high - a;
        let low = (a - (high - back)) - (b + back);
        DoubleDouble { high, low }
    }

    /// Rounds the number to f64.
    pub(crate) fn value(self) -> f64 {
        self.high + self.low
    }

    /// Returns the exact sum of two numbers as a double-double; the magnitude of the first must be at least that of the
    /// second.
    fn fast_two_sum(high: f64, low: f64) -> Self {
        let sum = high + low;
        DoubleDouble {
            high: sum,
            low: low - (sum - high),
        }
    }
}

impl Add for DoubleDouble {
    type Output = DoubleDouble;

    fn add(self, other: DoubleDouble) -> DoubleDouble {
        let sum = DoubleDouble::difference(self.high, -other.high);
        DoubleDouble::fast_two_sum(sum.high, sum.low + (self.low + other.low))
    }
}

impl Sub for DoubleDouble {
    type Output = DoubleDouble;

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

    fn mul(self, other: DoubleDouble) -> DoubleDouble {
        let high = self.high * other.high;
        let low = self.high.mul_add(other.high, -high);
        DoubleDouble::fast_two_sum(high, low + (self.high * other.low + self.low * other.high))
    }
}

/// A vector of three double-double numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct DoubleDoubleVector([DoubleDouble; 3]);

impl DoubleDoubleVector {
    /// Returns `a − b` without rounding.
    pub(crate) fn difference(a: DVec3, b: DVec3) -> Self {
        DoubleDoubleVector([0, 1, 2].map(|k| DoubleDouble::difference(a[k], b[k])))
    }

    pub(crate) fn cross(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        DoubleDoubleVector([b * f - c * e, c * d - a * f, a * e - b * d])
    }

    pub(crate) fn dot(self, other: Self) -> DoubleDouble {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        a * d + b * e + c * f
    }

    /// Rounds the vector to f64.
    pub(crate) fn value(self) -> DVec3 {
        DVec3::from_array(self.0.map(DoubleDouble::value))
    }
}

impl Add for DoubleDoubleVector {
    type Output = DoubleDoubleVector;

    fn add(self, other: Self) -> Self {
        DoubleDoubleVector([0, 1, 2].map(|k| self.0[k] + other.0[k]))
    }
}

/// Returns six times the volume of a tetrahedron, positive if the triangle is counterclockwise as seen from `d`.
pub(crate) fn six_times_signed_volume([a, b, c]: [DVec3; 3], d: DVec3) -> f64 {
    let from = |p: DVec3| DoubleDoubleVector::difference(p, a);
    from(b).cross(from(c)).dot(from(d)).value()
}

#[cfg(test)]
mod tests;
