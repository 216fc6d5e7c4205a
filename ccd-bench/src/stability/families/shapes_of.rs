//! Scenes of meshes with many triangles, and of meshes with repeated, collapsed or sliver triangles.

use super::super::family::{BodyMotion, Family, FamilyScene, truth_for_contact_time};
use super::super::shapes::{
    TOOTH_WIDTH_SHARE, ball, comb, cone, cube, cube_grid_half_inside_out, evenly_stacked_squares,
    sliver_slab, with_bad_faces,
};
use super::{fall_onto_slab, family, negative_powers_of_ten, powers_of_ten};
use anyhow::Result;
use ccd_core::glam::{DAffine3, DQuat, DVec3, dvec3};
use ccd_core::order::greater;
use std::f64::consts::PI;

pub(super) fn families() -> Vec<Family> {
    let doubled =
        |exponents: std::ops::RangeInclusive<i32>| exponents.map(|k| 2f64.powi(k)).collect();
    vec![
        family("comb into comb", comb_into_comb).with_parameter("teeth", doubled(2..=9)),
        family("ball onto a slab", ball_onto_slab)
            .with_parameter("triangles", powers_of_ten(2..=6)),
        family("tip of many triangles", tip_onto_slab)
            .with_parameter("triangles at the tip", powers_of_ten(1..=4)),
        family("repeated and collapsed faces", cube_with_bad_faces)
            .with_parameter("bad faces", powers_of_ten(0..=3)),
        family("layers close behind each other", cube_onto_layers)
            .with_parameter("layers", powers_of_ten(0..=4)),
        family("slab with a sliver", cube_onto_sliver)
            .with_parameter("width of the sliver", negative_powers_of_ten(0..=12)),
        family("field of solids", cube_onto_cube_field).with_parameter("solids", doubled(2..=12)),
        family("cones tip onto tip", tip_onto_tip)
            .with_parameter("way aside", negative_powers_of_ten(1..=12)),
    ]
}

/// Makes two combs whose teeth pass between each other, until their tips meet the bars (case T19).
fn comb_into_comb(teeth: f64) -> Result<FamilyScene> {
    let scene = FamilyScene::new(comb(teeth as u32)?, comb(teeth as u32)?);
    // Rotated by half a turn about y, a tooth ends at its mirror image: in the middle of a gap, at 1/2 +
    // TOOTH of the step.
    let shift = 1.0 - (0.5 - TOOTH_WIDTH_SHARE) / teeth;
    let falling = BodyMotion::straight(dvec3(shift, 0.0, 5.0), -4.0 * DVec3::Z)
        .with_orientation(DQuat::from_rotation_y(PI));
    scene.with_query_and_rotations(
        falling,
        BodyMotion::STILL,
        truth_for_contact_time(0.5, 1e-14),
    )
}

/// Makes a ball with a vertex at its pole that falls onto a slab (case T22).
fn ball_onto_slab(triangles: f64) -> Result<FamilyScene> {
    let falling = BodyMotion::FALLING.with_spin(2.0 * DVec3::Z);
    fall_onto_slab(ball(0.5, triangles as usize / 2 + 2)?, falling, 0.625)
}

/// Makes a cone that falls onto a slab, tip first.
fn tip_onto_slab(sides: f64) -> Result<FamilyScene> {
    let falling = BodyMotion::straight(2.5 * DVec3::Z, -4.0 * DVec3::Z).with_spin(2.0 * DVec3::Z);
    fall_onto_slab(cone(sides as u32, 0.7)?, falling, 0.625)
}

/// Makes a cube that falls onto the first of many open sheets.
fn cube_onto_layers(count: f64) -> Result<FamilyScene> {
    let scene = FamilyScene::new(cube()?, evenly_stacked_squares(count as u32)?);
    let falling = BodyMotion::FALLING;
    scene.with_query_and_rotations(
        falling,
        BodyMotion::STILL,
        truth_for_contact_time(0.625, 1e-14),
    )
}

/// Makes a cube with repeated and collapsed faces that falls onto a slab (case T21).
fn cube_with_bad_faces(count: f64) -> Result<FamilyScene> {
    let cube = with_bad_faces(&cube()?, count as usize)?;
    fall_onto_slab(cube, BodyMotion::FALLING, 0.625)
}

/// Makes a cube that falls onto a sliver triangle of a slab.
fn cube_onto_sliver(width: f64) -> Result<FamilyScene> {
    let scene = FamilyScene::new(cube()?, sliver_slab(width)?);
    let expected = truth_for_contact_time(0.625, 1e-14);
    scene.with_query_and_rotations(
        BodyMotion::FALLING,
        BodyMotion::RESTING_SLAB_MOTION,
        expected,
    )
}

/// Makes a cube that falls onto one mesh of many cubes, every other one of which is inside out.
fn cube_onto_cube_field(count: f64) -> Result<FamilyScene> {
    // The cube covers the middle of the field, where at least four others are.
    let scene = FamilyScene::new(cube()?, cube_grid_half_inside_out(count as u32)?);
    let expected = truth_for_contact_time(0.625, 1e-14);
    scene.with_query_and_rotations(BodyMotion::FALLING, BodyMotion::STILL, expected)
}

/// Makes two cones that meet nearly tip to tip: each tip touches a side of the other cone, slightly beside its tip.
fn tip_onto_tip(aside: f64) -> Result<FamilyScene> {
    let (sides, radius) = (8, 0.7);
    // After a rotation by half a side, a face looks along x. It rises by 1 up to its middle.
    let half_side = PI / f64::from(sides);
    let cone = cone(sides, radius)?.transformed(DAffine3::from_rotation_z(half_side))?;
    let slope = 1.0 / (radius * half_side.cos());
    let falling = BodyMotion::straight(dvec3(aside, 0.0, 2.0), -4.0 * DVec3::Z);
    let upside_down = BodyMotion::STILL.with_orientation(DQuat::from_rotation_y(PI));
    let scene = FamilyScene::new(cone.clone(), cone).with_tolerance(greater(0.1 * aside, 1e-11));
    let expected = truth_for_contact_time((2.0 + aside * slope) / 4.0, 1e-14);
    scene.with_query_and_rotations(falling, upside_down, expected)
}
