//! The position of a joint as a polynomial, with bounds of its values.

use ccd_core::order::{greater, lesser};

/// The largest degree of a polynomial, which has a fixed place in memory.
pub(crate) const MAX_DEGREE: usize = 9;

/// The ratio of the bound of a polynomial's range to what is seen of it, up to which the bound is taken.
const MAX_RANGE_WIDTH_RATIO: f64 = 2.0;

/// The number of times that a segment is halved to bound a polynomial's range.
const MAX_RANGE_HALVINGS: u32 = 6;

/// Returns the factor from the sum of a polynomial's coefficients, on a segment, to the magnitude of which its values are
/// rounded.
///
/// Horner's scheme rounds twice for each power, relative to the sum. So are the coefficients about a middle `m`, summed with
/// the powers of a half `h` as a deviation: `Σ |cₙ| (m + h)ⁿ` is at most the sum, because `m + h` is at most 1. As a deviation
/// from a chord they are weighted by at most `n (n−1)/2 h²`, which is at most 9 for degree 9. Each bound moves the polynomial
/// once. In units of `U` times the sum a value takes at most `2 n`, a deviation `4 n`, one from a chord `18 n`; the error of a
/// position has 16 for each unit of the factor.
pub(crate) fn rounding_factor(degree: usize) -> f64 {
    2.0 * (degree + 1) as f64
}

/// The position of a joint as a polynomial of the share of a segment, about some share of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polynomial {
    degree: usize,
    /// The coefficients, that of the lowest power first.
    coefficients: [f64; MAX_DEGREE + 1],
}

impl Polynomial {
    pub(crate) fn new(degree: usize, coefficient: impl Fn(usize) -> f64) -> Self {
        let mut coefficients = [0.0; MAX_DEGREE + 1];
        for (power, own) in coefficients[..=degree].iter_mut().enumerate() {
            *own = coefficient(power);
        }
        Polynomial {
            degree,
            coefficients,
        }
    }

    /// Returns the same polynomial about another share: its Taylor series there, by Horner's scheme.
    pub(crate) fn about(mut self, share: f64) -> Self {
        for lowest in 0..self.degree {
            for power in (lowest..self.degree).rev() {
                self.coefficients[power] += share * self.coefficients[power + 1];
            }
        }
        self
    }

    #[cfg(test)]
    pub(crate) fn coefficient(&self, power: usize) -> f64 {
        self.coefficients[power]
    }

    /// Bounds the rounding error of values on the segment.
    pub(crate) fn rounding(&self) -> f64 {
        8.0 * f64::EPSILON * rounding_factor(self.degree) * self.size()
    }

    /// Returns the sum of the absolute values of all coefficients.
    fn size(&self) -> f64 {
        self.coefficients.iter().map(|own| own.abs()).sum()
    }

    /// Bounds the values on the segment, for the polynomial about its start.
    pub(crate) fn range(&self) -> [f64; 2] {
        self.range_within(0.5, 0.5, MAX_RANGE_HALVINGS)
    }

    /// Bounds the values within a share of a middle to both sides. It halves the range as long as the bound is much wider than
    /// the values that are seen.
    fn range_within(&self, middle: f64, half: f64, halvings: u32) -> [f64; 2] {
        let about = self.about(middle);
        let (value, deviation) = (about.constant(), about.deviation_bound(half));
        let ends = [-half, half].map(|offset| about.about(offset).constant());
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
        self.coefficients[0]
    }

    /// Bounds how far values are from the one in the middle, within a share of it to both sides: `Σ |cᵢ| hⁱ`.
    pub(crate) fn deviation_bound(&self, half: f64) -> f64 {
        let rest = self.coefficients[1..=self.degree].iter().rev();
        half * rest.fold(0.0, |sum, coefficient| coefficient.abs() + half * sum)
    }

    /// Bounds how far values are from those of the line between both ends, within a share of the middle to both sides.
    ///
    /// A function is at most `(2h)²/8` times its largest second derivative from its chord: `Σ i (i−1)/2 |cᵢ| hⁱ`.
    pub(crate) fn chord_deviation_bound(&self, half: f64) -> f64 {
        let curved = self.coefficients[..=self.degree].iter().enumerate().skip(2);
        let sum = curved.rev().fold(0.0, |sum, (power, coefficient)| {
            let pairs = (power * (power - 1) / 2) as f64;
            pairs * coefficient.abs() + half * sum
        });
        // The square of a short half may be zero; each term has a few roundings.
        half * (half * sum) * (1.0 + 1e-12)
    }
}

#[cfg(test)]
mod tests;
