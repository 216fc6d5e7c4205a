//! The families of scenes, by the kind of difficulty. Case numbers such as T8 are those of `tests/it/scenes.rs`.

mod accuracy;
mod gaps;
mod interlocked;
mod shapes_of;
mod sizes;
mod times;
mod turning;

use super::family::{BodyMotion, Family, FamilyStep, contact_at};
use super::shapes::slab;
use anyhow::Result;
use ccd_decomp::TriangleMesh;

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
fn family(name: &'static str, make: fn(f64) -> Result<FamilyStep>) -> Family {
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

/// Returns the step of a body that falls onto a slab, and meets it at a time known to within 1e-14.
fn onto_slab(mesh: TriangleMesh, falling: BodyMotion, time: f64) -> Result<FamilyStep> {
    let step = FamilyStep::new(mesh, slab()?);
    let expected = contact_at(time, 1e-14);
    step.with_rotated_queries(falling, BodyMotion::SLAB_BELOW, expected)
}

#[cfg(test)]
mod tests;
