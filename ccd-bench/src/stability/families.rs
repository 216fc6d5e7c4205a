//! The families of scenes, by the kind of difficulty. Case numbers such as T8 are those of `tests/it/scenes.rs`.

mod accuracy;
mod gaps;
mod interlocked;
mod shapes_of;
mod sizes;
mod times;
mod turning;

use super::family::{BodyMotion, Family, FamilyScene, truth_for_contact_time};
use super::shapes::{cuboid, slab};
use crate::truth::Truth;
use anyhow::Result;
use ccd_core::glam::DVec3;
use ccd_decomp::{MeshError, TriangleMesh};

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

/// Creates a family with the given name and scenes; its parameter has no description and no values yet.
fn family(name: &'static str, make: fn(f64) -> Result<FamilyScene>) -> Family {
    Family {
        name,
        parameter_description: "",
        parameter_values: Vec::new(),
        make_scene: make,
    }
}

/// Returns the powers 10⁻ᵏ for each exponent k of a range.
fn negative_powers_of_ten(exponents: std::ops::RangeInclusive<i32>) -> Vec<f64> {
    exponents.map(|k| 10f64.powi(-k)).collect()
}

/// Returns the powers 10ᵏ for each exponent k of a range.
fn powers_of_ten(exponents: std::ops::RangeInclusive<i32>) -> Vec<f64> {
    exponents.map(|k| 10f64.powi(k)).collect()
}

/// Returns the scene in which a body falls onto a slab, and meets it at `time`, which is known to within 1e-14.
fn fall_onto_slab(mesh: TriangleMesh, falling: BodyMotion, time: f64) -> Result<FamilyScene> {
    let scene = FamilyScene::new(mesh, slab()?);
    let expected = truth_for_contact_time(time, 1e-14);
    scene.with_query_and_rotations(falling, BodyMotion::RESTING_SLAB_MOTION, expected)
}

/// The half length and the half width of a rod.
const ROD_HALF_SIDES: (f64, f64) = (2.0, 0.05);

/// Returns the mesh of a rod that stands upright.
fn rod() -> Result<TriangleMesh, MeshError> {
    cuboid(ROD_HALF_SIDES.1, 0.3, ROD_HALF_SIDES.0)
}

/// Returns the angle by which a rod at the origin turns about y until its corner is at x = `wall`.
fn rod_contact_angle(wall: f64) -> f64 {
    let (long, thin) = ROD_HALF_SIDES;
    (wall / long.hypot(thin)).asin() - thin.atan2(long)
}

/// Returns the scene in which a rod rotates at the origin, next to a wall whose near side is at x = `wall`.
fn rod_beside_wall(turning: BodyMotion, wall: f64, expected: Truth) -> Result<FamilyScene> {
    let scene = FamilyScene::new(rod()?, cuboid(1.0, 3.0, 3.0)?);
    let beside = BodyMotion::motion_at_rest((wall + 1.0) * DVec3::X);
    scene.with_query_and_rotations(turning, beside, expected)
}

#[cfg(test)]
mod tests;
