//! The families, by what makes them hard.

mod accuracy;
mod gaps;
mod shapes_of;
mod sizes;
mod times;
mod turning;

use super::family::Family;

/// Returns all families.
pub fn families() -> Vec<Family> {
    [
        gaps::families(),
        accuracy::families(),
        sizes::families(),
        turning::families(),
        times::families(),
        shapes_of::families(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Returns 10⁻ᵏ for each k.
fn tenths(exponents: std::ops::RangeInclusive<i32>) -> Vec<f64> {
    exponents.map(|k| 10f64.powi(-k)).collect()
}

/// Returns 10ᵏ for each k.
fn tens(exponents: std::ops::RangeInclusive<i32>) -> Vec<f64> {
    exponents.map(|k| 10f64.powi(k)).collect()
}

#[cfg(test)]
mod tests;
