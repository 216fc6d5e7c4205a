//! The families of scenes, by the kind of difficulty. Case numbers such as T8 are those of `tests/it/scenes.rs`.

mod accuracy;
mod gaps;
mod interlocked;
mod shapes_of;
mod sizes;
mod times;
mod turning;

use super::family::{Family, Step};
use anyhow::Result;

/// Returns all families of scenes.
pub fn families() -> Vec<Family> {
    [
        gaps::families(),
        accuracy::families(),
        sizes::families(),
        turning::families(),
        times::families(),
        shapes_of::families(),
        interlocked::families(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Returns a family with the given name, whose parameter is still unnamed and without values.
fn family(name: &'static str, make: fn(f64) -> Result<Step>) -> Family {
    Family {
        name,
        parameter: "",
        values: Vec::new(),
        make,
    }
}

/// Returns the powers 10⁻ᵏ for each k.
fn negative_powers_of_ten(exponents: std::ops::RangeInclusive<i32>) -> Vec<f64> {
    exponents.map(|k| 10f64.powi(-k)).collect()
}

/// Returns the powers 10ᵏ for each k.
fn powers_of_ten(exponents: std::ops::RangeInclusive<i32>) -> Vec<f64> {
    exponents.map(|k| 10f64.powi(k)).collect()
}

#[cfg(test)]
mod tests;
