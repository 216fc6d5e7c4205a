//! Interval arithmetic: each operation returns an interval that contains the exact results for all numbers in its
//! operands.
//!
//! Floats are computed to nearest, then moved outward if they are not exact. A result rounded to
//! nearest has the exact one strictly between its two neighbours, or equals it: between f64::MAX and
//! infinity if it overflows, around 0 and within the least float if it underflows. So the neighbours
//! are bounds. The sign of what was rounded off, where it is certain, tells which of them is needed.
//! None of this needs a rounding mode, a fused operation or any other feature of a processor beyond
//! floats of IEEE 754.
//!
//! Everything doubtful becomes the whole line, which proves nothing: bounds that are not numbers,
//! 0 times infinity, division by what may be 0, an operation that is left without operands.

use super::rounding::nan_propagating_max;
use ccd_core::order::{greater, lesser};
use std::ops::{Add, Div, Mul, Neg, RangeInclusive, Sub};

/// The real numbers from a lower bound to an upper bound, either of which may be infinite.
///
/// The bounds are in order, neither is NaN, and a real number is between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    inf: f64,
    sup: f64,
}

/// Returns the interval of a single float; the whole line if it is not finite.
pub(super) const fn point_interval(x: f64) -> Interval {
    Interval::new(x, x)
}

impl Interval {
    /// The interval of all real numbers.
    pub(super) const ALL_REALS: Interval = Interval {
        inf: f64::NEG_INFINITY,
        sup: f64::INFINITY,
    };
    /// The interval between the two floats around π/2, which exceeds the lower one by 6.1e-17.
    pub(super) const FRAC_PI_2: Interval = Interval {
        inf: std::f64::consts::FRAC_PI_2,
        sup: std::f64::consts::FRAC_PI_2.next_up(),
    };

    /// Returns the interval from `inf` to `sup`; all real numbers if no real number is between these bounds.
    pub(super) const fn new(inf: f64, sup: f64) -> Self {
        // The comparison is false for NaN.
        if inf <= sup && inf < f64::INFINITY && sup > f64::NEG_INFINITY {
            Interval { inf, sup }
        } else {
            Interval::ALL_REALS
        }
    }

    /// Returns the lower bound, −∞ if the interval is unbounded below.
    pub(super) fn inf(self) -> f64 {
        self.inf
    }

    /// Returns the upper bound, ∞ if the interval is unbounded above.
    pub(super) fn sup(self) -> f64 {
        self.sup
    }

    /// Returns a float near the middle; 0 if a bound is infinite.
    pub(super) fn midpoint(self) -> f64 {
        let mid = self.inf.midpoint(self.sup);
        if mid.is_finite() { mid } else { 0.0 }
    }

    /// Returns an upper bound of the distance of any number in the interval from the rounded middle `mid`.
    pub(super) fn radius(self) -> f64 {
        let mid = self.midpoint();
        let ([_, below], [_, above]) = (sum_bounds(mid, -self.inf), sum_bounds(self.sup, -mid));
        nan_propagating_max(below, above)
    }

    /// Returns the least upper bound of the numbers' absolute values.
    pub(super) fn magnitude(self) -> f64 {
        greater(self.inf.abs(), self.sup.abs())
    }

    /// Returns the interval of the numbers' absolute values. Nothing is rounded.
    pub(super) fn abs(self) -> Self {
        // At most one of the two is positive: the bound nearer to 0, if the interval does not contain 0.
        let least = greater(greater(self.inf, -self.sup), 0.0);
        Interval::new(least, self.magnitude())
    }

    /// Returns the interval of the numbers' squares. They grow with the absolute value, and none is negative, not even
    /// where the lower bound of a product is.
    pub(super) fn sqr(self) -> Self {
        let Interval { inf, sup } = self.abs();
        let ([least, _], [_, most]) = (product_bounds(inf, inf), product_bounds(sup, sup));
        Interval::new(greater(least, 0.0), most)
    }

    /// Returns the square roots of the nonnegative numbers in the interval; the whole line if there are none. Roots
    /// grow with their operand.
    pub(super) fn sqrt(self) -> Self {
        let ([least, _], [_, most]) = (sqrt_bounds(greater(self.inf, 0.0)), sqrt_bounds(self.sup));
        // `most` is NaN if all numbers are negative.
        Interval::new(least, most)
    }

    /// Returns the numbers that are in both intervals; the whole line if there are none. Two enclosures of the same
    /// number always have it in common. Nothing is rounded.
    pub(super) fn intersection(self, other: Self) -> Self {
        Interval::new(greater(self.inf, other.inf), lesser(self.sup, other.sup))
    }

    /// Returns the interval of products with `factor`, which must contain no negative number.
    fn times_nonnegative(self, factor: Self) -> Self {
        self.scaled_by_range(product_bounds, [factor.inf, factor.sup])
    }

    /// Returns the interval of quotients by `divisor`, which must contain only positive numbers.
    fn divided_by_positive(self, divisor: Self) -> Self {
        self.scaled_by_range(quotient_bounds, [divisor.sup, divisor.inf])
    }

    /// Returns the interval scaled by a range of nonnegative factors, from the weakest scaling `least` to the strongest
    /// `most`. The lower bound is scaled by `least`, or by `most` if it is negative; the upper bound by `most`, or by
    /// `least` if it is negative.
    fn scaled_by_range(
        self,
        scaled: impl Fn(f64, f64) -> [f64; 2],
        [least, most]: [f64; 2],
    ) -> Self {
        let [inf, _] = scaled(self.inf, if self.inf >= 0.0 { least } else { most });
        let [_, sup] = scaled(self.sup, if self.sup >= 0.0 { most } else { least });
        Interval::new(inf, sup)
    }
}

impl Neg for Interval {
    type Output = Interval;

    /// Returns the interval of the negated numbers. Nothing is rounded.
    fn neg(self) -> Interval {
        Interval::new(-self.sup, -self.inf)
    }
}

impl Add for Interval {
    type Output = Interval;

    /// Returns an interval that contains all sums of the numbers in two intervals. A sum is increasing in both
    /// operands.
    fn add(self, other: Interval) -> Interval {
        let ([inf, _], [_, sup]) = (
            sum_bounds(self.inf, other.inf),
            sum_bounds(self.sup, other.sup),
        );
        Interval::new(inf, sup)
    }
}

impl Sub for Interval {
    type Output = Interval;

    /// Returns an interval that contains all differences of the numbers in two intervals.
    fn sub(self, other: Interval) -> Interval {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Interval;

    /// Returns an interval that contains all products of the numbers in two intervals. A product is linear in each
    /// operand, so that it is least and greatest at bounds: at two of them, unless both operands have numbers on both
    /// sides of 0.
    fn mul(self, other: Interval) -> Interval {
        if other.inf >= 0.0 {
            return self.times_nonnegative(other);
        }
        if other.sup <= 0.0 {
            return -self.times_nonnegative(-other);
        }
        if self.inf >= 0.0 {
            return other.times_nonnegative(self);
        }
        if self.sup <= 0.0 {
            return -other.times_nonnegative(-self);
        }
        let ([x, _], [_, y]) = (
            product_bounds(self.inf, other.sup),
            product_bounds(self.inf, other.inf),
        );
        let ([u, _], [_, v]) = (
            product_bounds(self.sup, other.inf),
            product_bounds(self.sup, other.sup),
        );
        Interval::new(-nan_propagating_max(-x, -u), nan_propagating_max(y, v))
    }
}

impl Div for Interval {
    type Output = Interval;

    /// Returns an interval that contains all quotients of the numbers in two intervals; the whole line if the divisor
    /// may be 0.
    fn div(self, other: Interval) -> Interval {
        if other.inf > 0.0 {
            self.divided_by_positive(other)
        } else if other.sup < 0.0 {
            -self.divided_by_positive(-other)
        } else {
            Interval::ALL_REALS
        }
    }
}

/// Returns bounds of an exact result, given its rounded value and the sign of the rounding error. The sign of `rest` is
/// that of the exact result minus the rounded one. Only the bound on that side is moved to the next float: no bound if
/// `rest` is 0, both bounds if it is NaN.
fn rounded_outward(rounded: f64, rest: f64) -> [f64; 2] {
    [
        if rest >= 0.0 {
            rounded
        } else {
            rounded.next_down()
        },
        if rest <= 0.0 {
            rounded
        } else {
            rounded.next_up()
        },
    ]
}

/// Returns bounds of the exact sum of two floats.
///
/// Knuth's error of a sum (TwoSum) is exact unless something overflows, and then it is not finite.
/// Small sums are exact.
fn sum_bounds(x: f64, y: f64) -> [f64; 2] {
    let sum = x + y;
    let back = sum - x;
    let rest = (x - (sum - back)) + (y - back);
    rounded_outward(sum, if rest.is_finite() { rest } else { f64::NAN })
}

/// Returns bounds of the exact product of two floats; NaN for 0 times infinity.
fn product_bounds(x: f64, y: f64) -> [f64; 2] {
    let product = x * y;
    if x == 0.0 || y == 0.0 {
        return [product; 2];
    }
    rounded_outward(product, -product_residual(product, x, y))
}

/// Returns bounds of the exact quotient of two floats; the divisor must not be 0. A number over infinity stands for
/// quotients that come near 0.
fn quotient_bounds(x: f64, y: f64) -> [f64; 2] {
    let quotient = x / y;
    if x == 0.0 {
        return [quotient; 2];
    }
    rounded_outward(quotient, product_residual(x, quotient, y) * y.signum())
}

/// Returns bounds of an exact square root, which `f64::sqrt` rounds to nearest; NaN for negative numbers.
fn sqrt_bounds(x: f64) -> [f64; 2] {
    let root = x.sqrt();
    if x == 0.0 {
        return [root; 2];
    }
    rounded_outward(root, product_residual(x, root, root))
}

/// Returns w − xy with the right sign, for a w within a factor of 2 of xy; NaN if the sign might be wrong.
///
/// Dekker's product is exact: xy is the rounded product and an error, without a fused operation. The
/// halves have 26 bits, so their products are exact. w less the rounded product is exact by Sterbenz.
fn product_residual(w: f64, x: f64, y: f64) -> f64 {
    if !(SAFE_FACTOR_RANGE.contains(&x.abs()) && SAFE_FACTOR_RANGE.contains(&y.abs())) {
        return f64::NAN;
    }
    let ([x_high, x_low], [y_high, y_low]) = (split_float(x), split_float(y));
    let product = x * y;
    let error = ((x_high * y_high - product) + x_high * y_low + x_low * y_high) + x_low * y_low;
    (w - product) - error
}

/// The range of factors for which no part of Dekker's product overflows or underflows. The lowest bit of the least
/// product is at 1e-280 2⁻¹⁰⁴, above the least float.
const SAFE_FACTOR_RANGE: RangeInclusive<f64> = 1e-140..=1e140;

/// Splits a float into a sum of two floats of at most 26 bits each, as Veltkamp does.
fn split_float(x: f64) -> [f64; 2] {
    const SPLITTER: f64 = 134_217_729.0; // 2²⁷ + 1
    let scaled = SPLITTER * x;
    let high = scaled - (scaled - x);
    [high, x - high]
}
