//! Scenes whose contact is close to the start or close to the end.

use super::super::family::{BodyMotion, Family, FamilyScene, truth_for_contact_time};
use super::super::shapes::{cube, sheet, slab};
use super::{family, negative_powers_of_ten};
use crate::truth::Truth;
use anyhow::Result;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

pub(super) fn families() -> Vec<Family> {
    let family =
        |name, values, make| family(name, make).with_parameter("time to the limit", values);
    vec![
        family(
            "contact after the start",
            negative_powers_of_ten(1..=12),
            contact_after_start,
        ),
        family(
            "contact before the end",
            negative_powers_of_ten(1..=14),
            contact_before_end,
        ),
        family(
            "contact after the end",
            negative_powers_of_ten(1..=12),
            contact_after_end,
        ),
        family(
            "sheet falling onto a sheet",
            negative_powers_of_ten(1..=12),
            sheet_onto_sheet,
        ),
    ]
}

/// Returns the meshes and the motion of a cube that falls at speed 1 onto a slab, and reaches it at a given time.
fn cube_falling_onto_slab(time: f64) -> Result<(FamilyScene, BodyMotion)> {
    let scene = FamilyScene::new(cube()?, slab()?);
    Ok((
        scene,
        BodyMotion::straight((0.5 + time) * DVec3::Z, DVec3::NEG_Z),
    ))
}

fn contact_after_start(time: f64) -> Result<FamilyScene> {
    let (scene, falling) = cube_falling_onto_slab(time)?;
    let scene = scene.with_tolerance(greater(0.1 * time, 1e-11));
    let expected = truth_for_contact_time(time, 1e-14);
    scene.with_query_and_rotations(falling, BodyMotion::RESTING_SLAB_MOTION, expected)
}

fn contact_before_end(before: f64) -> Result<FamilyScene> {
    let (scene, falling) = cube_falling_onto_slab(1.0 - before)?;
    let expected = truth_for_contact_time(1.0 - before, 1e-14);
    scene.with_query_and_rotations(falling, BodyMotion::RESTING_SLAB_MOTION, expected)
}

fn contact_after_end(after: f64) -> Result<FamilyScene> {
    let (scene, falling) = cube_falling_onto_slab(1.0 + after)?;
    let scene = scene.with_tolerance(greater(0.25 * after, 1e-11));
    let slab = BodyMotion::RESTING_SLAB_MOTION;
    scene.with_query_and_rotations_if(after > 1e-12, falling, slab, Truth::Free)
}

/// Makes two flat sheets without thickness that start at a small distance and meet face to face.
fn sheet_onto_sheet(way: f64) -> Result<FamilyScene> {
    let falling = BodyMotion::straight(way * DVec3::Z, DVec3::NEG_Z);
    let scene = FamilyScene::new(sheet(4)?, sheet(4)?).with_tolerance(greater(0.1 * way, 1e-11));
    scene.with_query_and_rotations(
        falling,
        BodyMotion::STILL,
        truth_for_contact_time(way, 1e-14),
    )
}
