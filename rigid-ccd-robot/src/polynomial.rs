//! The position of a joint as a polynomial, with bounds of its values.
//!
//! The values on a segment may be far smaller than the coefficients: a Chebyshev polynomial of degree 9 has values up
//! to 1, but the absolute values of its coefficients add up to 4 million. Coefficients are therefore double-double
//! numbers, so that rounding errors are relative to the values.

use ccd_core::double_double::DoubleDouble;
use ccd_core::order::{greater, lesser};

/// The largest supported degree.
pub(crate) const MAX_DEGREE: usize = 9;

/// A bound of a polynomial's range is accepted if it is at most this many times as wide as the range of sampled
/// values.
const MAX_RANGE_WIDTH_RATIO: f64 = 2.0;

/// The number of halvings of a segment to bound a polynomial's range.
const MAX_RANGE_HALVINGS: u32 = 6;

/// An error bound of double-double arithmetic, relative to the sum of the coefficients' absolute values. It covers
/// values and bounds of deviations.
///
/// Horner's scheme rounds twice for each power, by at most 2⁻¹⁰² of the sum each. For the polynomial expanded about
/// `m` and a deviation of `h`, `Σ |cₙ| (m + h)ⁿ` is at most the sum, because `m + h` is at most 1. For the deviation
/// from a chord, terms are weighted by at most `n (n−1)/2 h²`, which is at most 9 for degree 9. The total is below `18
/// · 10 · 2⁻¹⁰²`, and below 2⁻⁹⁴.
pub(crate) const EXTENDED_PRECISION_ERROR: f64 = 1.0 / (1u128 << 94) as f64;

/// Enlarges bounds of deviations, to cover the rounding of coefficients to f64 and a few roundings for each of at most
/// ten terms.
const ROUNDING_FACTOR: f64 = 1.0 + 1e-12;

/// The position of a joint as a polynomial of the fraction of a segment, expanded about some fraction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polynomial {
    degree: usize,
    /// The coefficients, lowest power first.
    coefficients: [DoubleDouble; MAX_DEGREE + 1],
}

impl Polynomial {
    pub(crate) fn new(degree: usize, coefficient: impl Fn(usize) -> DoubleDouble) -> Self {
        let mut coefficients = [DoubleDouble::default(); MAX_DEGREE + 1];
        for (power, stored) in coefficients[..=degree].iter_mut().enumerate() {
            *stored = coefficient(power);
        }
        Polynomial {
            degree,
            coefficients,
        }
    }

    /// Returns the polynomial expanded about another fraction: its Taylor series there, by Horner's scheme.
    pub(crate) fn expanded_about(mut self, fraction: f64) -> Self {
        let fraction = DoubleDouble::from(fraction);
        for lowest in 0..self.degree {
            for power in (lowest..self.degree).rev() {
                self.coefficients[power] =
                    self.coefficients[power] + fraction * self.coefficients[power + 1];
            }
        }
        self
    }

    /// Returns the value at an offset from the expansion point, by Horner's scheme, rounded to f64.
    pub(crate) fn value(&self, offset: f64) -> f64 {
        let offset = DoubleDouble::from(offset);
        let highest_first = self.coefficients[..=self.degree].iter().rev();
        let zero = DoubleDouble::default();
        let sum = highest_first.fold(zero, |sum, &coefficient| coefficient + offset * sum);
        sum.value()
    }

    /// Returns the value and the derivative at an offset from the expansion point, rounded to f64.
    pub(crate) fn value_and_rate(&self, offset: f64) -> [f64; 2] {
        let offset = DoubleDouble::from(offset);
        let (mut value, mut rate) = (DoubleDouble::default(), DoubleDouble::default());
        for &coefficient in self.coefficients[..=self.degree].iter().rev() {
            rate = value + offset * rate;
            value = coefficient + offset * value;
        }
        [value.value(), rate.value()]
    }

    #[cfg(test)]
    pub(crate) fn coefficient(&self, power: usize) -> f64 {
        self.coefficients[power].value()
    }

    /// Bounds the error of values if each coefficient was rounded a few times.
    pub(crate) fn rounding_of_coefficients(&self) -> f64 {
        16.0 * f64::EPSILON * (self.degree + 1) as f64 * self.coefficient_magnitude_sum()
    }

    /// Returns the sum of the absolute values of all coefficients.
    pub(crate) fn coefficient_magnitude_sum(&self) -> f64 {
        let all = self.coefficients.iter();
        all.map(|coefficient| coefficient.value().abs()).sum()
    }

    /// Bounds the values on the segment. The polynomial must be expanded about the segment's start.
    pub(crate) fn range(&self) -> [f64; 2] {
        self.range_within(0.5, 0.5, MAX_RANGE_HALVINGS)
    }

    /// Bounds the values within `half` of `center`. Halves the range while the bound is much wider than the sampled
    /// values.
    fn range_within(&self, center: f64, half: f64, halvings: u32) -> [f64; 2] {
        let expanded = self.expanded_about(center);
        let (value, deviation) = (expanded.constant(), expanded.deviation_bound(half));
        let ends = [-half, half].map(|offset| expanded.value(offset));
        let sampled = greater((ends[0] - value).abs(), (ends[1] - value).abs());
        if halvings == 0 || deviation <= MAX_RANGE_WIDTH_RATIO * sampled {
            return [value - deviation, value + deviation];
        }
        let quarter = 0.5 * half;
        let [first, last] = [center - quarter, center + quarter]
            .map(|center| self.range_within(center, quarter, halvings - 1));
        [lesser(first[0], last[0]), greater(first[1], last[1])]
    }

    /// Returns the value at the expansion point.
    pub(crate) fn constant(&self) -> f64 {
        self.coefficients[0].value()
    }

    /// Bounds the deviation from the value at the expansion point, within `half` of it: `Σ |cᵢ| hⁱ`.
    pub(crate) fn deviation_bound(&self, half: f64) -> f64 {
        let rest = self.coefficients[1..=self.degree].iter().rev();
        let sum = rest.fold(0.0, |sum, coefficient| {
            coefficient.value().abs() + half * sum
        });
        half * sum * ROUNDING_FACTOR
    }

    /// Bounds the absolute value of the derivative within `half` of the expansion point: `Σ i |cᵢ| hⁱ⁻¹`.
    pub(crate) fn rate_bound(&self, half: f64) -> f64 {
        let rest = self.coefficients[..=self.degree].iter().enumerate().skip(1);
        let sum = rest.rev().fold(0.0, |sum, (power, coefficient)| {
            power as f64 * coefficient.value().abs() + half * sum
        });
        sum * ROUNDING_FACTOR
    }

    /// Bounds the absolute value of the second derivative within `half` of the expansion point: `Σ i (i−1) |cᵢ| hⁱ⁻²`.
    pub(crate) fn second_derivative_bound(&self, half: f64) -> f64 {
        let higher_terms = self.coefficients[..=self.degree].iter().enumerate().skip(2);
        let sum = higher_terms.rev().fold(0.0, |sum, (power, coefficient)| {
            (power * (power - 1)) as f64 * coefficient.value().abs() + half * sum
        });
        sum * ROUNDING_FACTOR
    }

    /// Bounds the deviation from the chord between the values at `-half` and `half`.
    ///
    /// A function deviates from its chord by at most `(2h)²/8` times its largest second derivative.
    pub(crate) fn chord_deviation_bound(&self, half: f64) -> f64 {
        // Multiplies twice, because the square of a small `half` may underflow.
        half * (half * (0.5 * self.second_derivative_bound(half)))
    }
}

#[cfg(test)]
mod tests;
