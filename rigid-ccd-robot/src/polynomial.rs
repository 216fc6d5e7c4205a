//! The position of a joint as a polynomial, with bounds of its values.
//!
//! The values of a polynomial on a segment may be far smaller than its coefficients: those of a Chebyshev polynomial of degree 9
//! are up to 1, and the sum of its coefficients is 4 million. Coefficients are therefore double-double numbers. What is computed
//! of them is then rounded like the values, not like the coefficients.

use ccd_core::double_double::DoubleDouble;
use ccd_core::order::{greater, lesser};

/// The largest degree of a polynomial, which has a fixed place in memory.
pub(crate) const MAX_DEGREE: usize = 9;

/// The ratio of the bound of a polynomial's range to what is seen of it, up to which the bound is taken.
const MAX_RANGE_WIDTH_RATIO: f64 = 2.0;

/// The number of times that a segment is halved to bound a polynomial's range.
const MAX_RANGE_HALVINGS: u32 = 6;

/// A bound of the errors of double-double arithmetic in values and in bounds of deviations, relative to the sum of the
/// coefficients' magnitudes.
///
/// Horner's scheme rounds twice for each power, by at most 2⁻¹⁰² of the sum. So are the coefficients about a middle `m`, summed
/// with the powers of a half `h` as a deviation: `Σ |cₙ| (m + h)ⁿ` is at most the sum, because `m + h` is at most 1. As a deviation
/// from a chord they are weighted by at most `n (n−1)/2 h²`, which is at most 9 for degree 9. That is below `18 · 10 · 2⁻¹⁰²`, or
/// 2⁻⁹⁴.
pub(crate) const EXTENDED_PRECISION_ERROR: f64 = 1.0 / (1u128 << 94) as f64;

/// The factor that raises a bound of a deviation. Coefficients are rounded to f64, and each of at most ten terms has a few
/// roundings.
const ROUNDING_FACTOR: f64 = 1.0 + 1e-12;

/// The position of a joint as a polynomial of the share of a segment, about some share of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polynomial {
    degree: usize,
    /// The coefficients, that of the lowest power first.
    coefficients: [DoubleDouble; MAX_DEGREE + 1],
}

impl Polynomial {
    pub(crate) fn new(degree: usize, coefficient: impl Fn(usize) -> DoubleDouble) -> Self {
        let mut coefficients = [DoubleDouble::default(); MAX_DEGREE + 1];
        for (power, own) in coefficients[..=degree].iter_mut().enumerate() {
            *own = coefficient(power);
        }
        Polynomial {
            degree,
            coefficients,
        }
    }

    /// Returns the same polynomial about another share: its Taylor series there, by Horner's scheme.
    pub(crate) fn expanded_about(mut self, share: f64) -> Self {
        let share = DoubleDouble::from(share);
        for lowest in 0..self.degree {
            for power in (lowest..self.degree).rev() {
                self.coefficients[power] =
                    self.coefficients[power] + share * self.coefficients[power + 1];
            }
        }
        self
    }

    /// Returns the value at a share, by Horner's scheme. It is rounded to f64.
    pub(crate) fn value(&self, share: f64) -> f64 {
        let share = DoubleDouble::from(share);
        let all = self.coefficients[..=self.degree].iter().rev();
        let zero = DoubleDouble::default();
        all.fold(zero, |value, &own| own + share * value).value()
    }

    #[cfg(test)]
    pub(crate) fn coefficient(&self, power: usize) -> f64 {
        self.coefficients[power].value()
    }

    /// Bounds how far values are from those of the polynomial that is meant, if each coefficient was rounded a few times.
    pub(crate) fn rounding_of_coefficients(&self) -> f64 {
        16.0 * f64::EPSILON * (self.degree + 1) as f64 * self.coefficient_magnitude_sum()
    }

    /// Returns the sum of the absolute values of all coefficients.
    pub(crate) fn coefficient_magnitude_sum(&self) -> f64 {
        let all = self.coefficients.iter();
        all.map(|own| own.value().abs()).sum()
    }

    /// Bounds the values on the segment, for the polynomial about its start.
    pub(crate) fn range(&self) -> [f64; 2] {
        self.range_within(0.5, 0.5, MAX_RANGE_HALVINGS)
    }

    /// Bounds the values within a share of a middle to both sides. It halves the range as long as the bound is much wider than
    /// the values that are seen.
    fn range_within(&self, middle: f64, half: f64, halvings: u32) -> [f64; 2] {
        let expanded = self.expanded_about(middle);
        let (value, deviation) = (expanded.constant(), expanded.deviation_bound(half));
        let ends = [-half, half].map(|offset| expanded.value(offset));
        let seen = greater((ends[0] - value).abs(), (ends[1] - value).abs());
        if halvings == 0 || deviation <= MAX_RANGE_WIDTH_RATIO * seen {
            return [value - deviation, value + deviation];
        }
        let quarter = 0.5 * half;
        let [first, last] = [middle - quarter, middle + quarter]
            .map(|middle| self.range_within(middle, quarter, halvings - 1));
        [lesser(first[0], last[0]), greater(first[1], last[1])]
    }

    /// Returns the value at the share about which the polynomial is.
    pub(crate) fn constant(&self) -> f64 {
        self.coefficients[0].value()
    }

    /// Bounds how far values are from the one in the middle, within a share of it to both sides: `Σ |cᵢ| hⁱ`.
    pub(crate) fn deviation_bound(&self, half: f64) -> f64 {
        let rest = self.coefficients[1..=self.degree].iter().rev();
        let sum = rest.fold(0.0, |sum, own| own.value().abs() + half * sum);
        half * sum * ROUNDING_FACTOR
    }

    /// Bounds the absolute value of the derivative within a share of the middle to both sides: `Σ i |cᵢ| hⁱ⁻¹`.
    pub(crate) fn rate_bound(&self, half: f64) -> f64 {
        let rest = self.coefficients[..=self.degree].iter().enumerate().skip(1);
        let sum = rest.rev().fold(0.0, |sum, (power, own)| {
            power as f64 * own.value().abs() + half * sum
        });
        sum * ROUNDING_FACTOR
    }

    /// Bounds how far values are from those of the line between both ends, within a share of the middle to both sides.
    ///
    /// A function is at most `(2h)²/8` times its largest second derivative from its chord: `Σ i (i−1)/2 |cᵢ| hⁱ`.
    pub(crate) fn chord_deviation_bound(&self, half: f64) -> f64 {
        let curved = self.coefficients[..=self.degree].iter().enumerate().skip(2);
        let sum = curved.rev().fold(0.0, |sum, (power, coefficient)| {
            let pairs = (power * (power - 1) / 2) as f64;
            pairs * coefficient.value().abs() + half * sum
        });
        // The square of a short half may be zero.
        half * (half * sum) * ROUNDING_FACTOR
    }
}

#[cfg(test)]
mod tests;
