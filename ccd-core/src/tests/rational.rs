//! Exact fractions, to compute sums and products of numbers of any magnitude without rounding.
//!
//! Other crates of the workspace include this file by its path.

use dashu_ratio::Relaxed;

/// A vector of three fractions.
#[derive(Clone, Debug)]
pub(crate) struct Exact3(pub(crate) [Relaxed; 3]);

/// Converts a finite number to a fraction.
pub(crate) fn exact_fraction(x: f64) -> Relaxed {
    Relaxed::try_from(x).expect("a finite number")
}

/// Returns the absolute difference of a number from the exact value `truth`.
pub(crate) fn error_of(x: f64, truth: &Relaxed) -> f64 {
    (exact_fraction(x) - truth).to_f64().value().abs()
}

impl Exact3 {
    pub(crate) fn from_coordinates(v: impl Into<[f64; 3]>) -> Self {
        Exact3(v.into().map(exact_fraction))
    }

    pub(crate) fn minus(&self, other: &Self) -> Self {
        Exact3([0, 1, 2].map(|k| &self.0[k] - &other.0[k]))
    }

    pub(crate) fn dot(&self, other: &Self) -> Relaxed {
        let [x, y, z] = [0, 1, 2].map(|k| &self.0[k] * &other.0[k]);
        x + y + z
    }

    pub(crate) fn cross(&self, other: &Self) -> Self {
        let turned = |k: usize, l: usize| &self.0[k] * &other.0[l] - &self.0[l] * &other.0[k];
        Exact3([turned(1, 2), turned(2, 0), turned(0, 1)])
    }
}
