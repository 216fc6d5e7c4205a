//! The families, by the kind of difficulty.

mod accuracy;
mod gaps;
mod interlocked;
mod shapes_of;
mod sizes;
mod times;
mod turning;

use super::family::{Family, Step, StepError};

/// Returns all families.
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

fn family(
    name: &'static str,
    parameter: &'static str,
    values: Vec<f64>,
    make: fn(f64) -> Result<Step, StepError>,
) -> Family {
    Family {
        name,
        parameter,
        values,
        make,
    }
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
