//! Scenes of bodies that never meet, with smaller and smaller gaps.

use super::super::family::{BodyMotion, Family, FamilyScene};
use super::super::shapes::{ball, cone, cube, cuboid, holed_plate, slab};
use super::{ROD_HALF_SIDES, family, negative_powers_of_ten, rod_beside_wall};
use crate::truth::Truth;
use anyhow::Result;
use ccd_core::glam::{DVec3, dvec3};
use ccd_core::order::greater;

pub(super) fn families() -> Vec<Family> {
    let family =
        |name, make| family(name, make).with_parameter("gap", negative_powers_of_ten(1..=12));
    vec![
        family("ball passing a box", ball_passing_a_box),
        family("cubes passing", cubes_passing),
        family("balls passing pole to pole", balls_passing),
        family("cube sliding over a slab", cube_sliding_over_slab),
        family("cube resting then leaving", cube_leaving_slab),
        family("spinning top", spinning_top),
        family("rod turning past a wall", rod_turning_past_wall),
        family("peg passing through a hole", peg_through_a_hole),
    ]
}

/// Returns the tolerance for a gap: a quarter of it, or the least that can be certified for coordinates of a few units.
fn tolerance(gap: f64) -> f64 {
    greater(0.25 * gap, 2.5e-13)
}

/// Returns the scene with a contact-free query, repeated in rotated worlds if the gap survives their rounding.
fn contact_free_scene(
    scene: FamilyScene,
    gap: f64,
    a: BodyMotion,
    b: BodyMotion,
) -> Result<FamilyScene> {
    let scene = scene.with_tolerance(tolerance(gap));
    scene.with_query_and_rotations_if(gap >= 1e-12, a, b, Truth::Free)
}

fn ball_passing_a_box(gap: f64) -> Result<FamilyScene> {
    let scene = FamilyScene::new(ball(0.5, 600)?, cuboid(1.0, 1.0, 1.0)?);
    let flying = BodyMotion::straight(dvec3(-2.0, 0.0, 0.5 + gap), 4.0 * DVec3::X);
    contact_free_scene(scene, gap, flying, BodyMotion::RESTING_SLAB_MOTION)
}

fn cubes_passing(gap: f64) -> Result<FamilyScene> {
    let scene = FamilyScene::new(cube()?, cube()?);
    let flying = BodyMotion::straight(dvec3(-2.0, 0.0, 1.0 + gap), 4.0 * DVec3::X);
    contact_free_scene(scene, gap, flying, BodyMotion::STILL)
}

fn balls_passing(gap: f64) -> Result<FamilyScene> {
    let scene = FamilyScene::new(ball(0.5, 600)?, ball(0.5, 600)?);
    let flying = BodyMotion::straight(dvec3(-2.0, 0.0, 1.0 + gap), 4.0 * DVec3::X);
    contact_free_scene(scene, gap, flying, BodyMotion::STILL)
}

fn cube_sliding_over_slab(gap: f64) -> Result<FamilyScene> {
    let scene = FamilyScene::new(cube()?, slab()?);
    let sliding = BodyMotion::straight(dvec3(-2.0, 0.3, 0.5 + gap), dvec3(4.0, 1.0, 0.0));
    contact_free_scene(scene, gap, sliding, BodyMotion::RESTING_SLAB_MOTION)
}

fn cube_leaving_slab(gap: f64) -> Result<FamilyScene> {
    let scene = FamilyScene::new(cube()?, slab()?);
    let rising = BodyMotion::straight(dvec3(-2.0, 0.3, 0.5 + gap), dvec3(1.0, 0.0, 0.5));
    contact_free_scene(scene, gap, rising, BodyMotion::RESTING_SLAB_MOTION)
}

/// Makes a square peg that moves through a square hole, with a gap on all four sides (case T16).
fn peg_through_a_hole(gap: f64) -> Result<FamilyScene> {
    let scene = FamilyScene::new(cuboid(0.5, 0.5, 1.0)?, holed_plate(0.5 + gap)?);
    let falling = BodyMotion::straight(2.0 * DVec3::Z, -4.0 * DVec3::Z);
    contact_free_scene(scene, gap, falling, BodyMotion::STILL)
}

fn spinning_top(gap: f64) -> Result<FamilyScene> {
    let spinning = BodyMotion::straight(gap * DVec3::Z, 0.5 * DVec3::X).with_spin(50.0 * DVec3::Z);
    let scene = FamilyScene::new(cone(24, 0.7)?, slab()?);
    contact_free_scene(scene, gap, spinning, BodyMotion::RESTING_SLAB_MOTION)
}

/// Makes a rod that rotates by half a turn about its middle, past a wall that its corners miss by a gap.
fn rod_turning_past_wall(gap: f64) -> Result<FamilyScene> {
    let reach = f64::hypot(ROD_HALF_SIDES.0, ROD_HALF_SIDES.1);
    let turning = BodyMotion::STILL.with_spin(std::f64::consts::PI * DVec3::Y);
    // The reach is rounded, and the gap with it.
    let scene = rod_beside_wall(turning, reach + gap, Truth::Free)?;
    Ok(scene.with_tolerance(greater(tolerance(gap), 1e-11)))
}
