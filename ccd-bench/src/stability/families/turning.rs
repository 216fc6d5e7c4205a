//! Scenes of rotations, from very small ones to thousands of turns.

use super::super::family::{BodyMotion, Family, FamilyScene, truth_for_contact_time};
use super::super::shapes::{cube, cuboid};
use super::{
    ROD_HALF_SIDES, fall_onto_slab, family, powers_of_ten, rod, rod_beside_wall, rod_contact_angle,
};
use anyhow::Result;
use ccd_core::glam::{DAffine3, DVec3};
use std::f64::consts::{PI, TAU};

pub(super) fn families() -> Vec<Family> {
    let spins = vec![2.2, 2.5, 3.0, 4.0, 5.0, 6.0, 10.0, 100.0];
    vec![
        family("mace", arm_swinging_into_wall).with_parameter("radians", spins),
        family("drilling cube", cube_falling_while_spinning)
            .with_parameter("turns", powers_of_ten(-2..=4)),
        family("rod turning into a wall", rod_into_a_wall)
            .with_parameter("turns", powers_of_ten(0..=4)),
        family("rods turning against each other", counter_rotating_rods)
            .with_parameter("turns", powers_of_ten(0..=4)),
    ]
}

/// Makes a cube that falls flat onto a slab while it rotates about the vertical.
fn cube_falling_while_spinning(turns: f64) -> Result<FamilyScene> {
    let falling = BodyMotion::FALLING.with_spin(TAU * turns * DVec3::Z);
    fall_onto_slab(cube()?, falling, 0.625)
}

/// Makes an upright rod that rotates until its corner meets a wall at x = 1.2, within the first quarter of a turn. The
/// scene is like T4 of `tests/it/scenes.rs`.
fn rod_into_a_wall(turns: f64) -> Result<FamilyScene> {
    let wall = 1.2;
    let spin = TAU * turns;
    let turning = BodyMotion::STILL.with_spin(spin * DVec3::Y);
    let expected = truth_for_contact_time(rod_contact_angle(wall) / spin, 1e-15);
    rod_beside_wall(turning, wall, expected)
}

/// Makes an arm that hangs down from its center of rotation, and swings round until it hits a wall above the center.
/// The scene is like T9 of `tests/it/scenes.rs`. At the start its tip moves along the wall, so that a bound on the
/// speeds of that moment finds no approach.
fn arm_swinging_into_wall(spin: f64) -> Result<FamilyScene> {
    let (arm, wall): (f64, f64) = (2.0, 1.0);
    let hanging = cuboid(ROD_HALF_SIDES.1, 0.5 * arm, ROD_HALF_SIDES.1)?;
    let hanging = hanging.transformed(DAffine3::from_translation(-0.5 * arm * DVec3::Y))?;
    let swinging = BodyMotion::STILL.with_spin(spin * DVec3::Z);
    let angle = arm.atan2(ROD_HALF_SIDES.1) + (wall / arm.hypot(ROD_HALF_SIDES.1)).asin();
    let scene = FamilyScene::new(hanging, cuboid(3.0, 1.0, 3.0)?);
    let expected = truth_for_contact_time(angle / spin, 1e-15);
    scene.with_query_and_rotations(
        swinging,
        BodyMotion::motion_at_rest((wall + 1.0) * DVec3::Y),
        expected,
    )
}

/// Makes two parallel rods that rotate in opposite directions, as mirror images, until they meet. The scene is like T14
/// of `tests/it/scenes.rs`.
fn counter_rotating_rods(turns: f64) -> Result<FamilyScene> {
    let (apart, spin) = (3.0, TAU * turns);
    let turning =
        |spin: f64, x: f64| BodyMotion::motion_at_rest(x * DVec3::X).with_spin(spin * DVec3::Y);
    let angle = rod_contact_angle(0.5 * apart);
    debug_assert!(angle < PI);
    let scene = FamilyScene::new(rod()?, rod()?);
    let expected = truth_for_contact_time(angle / spin, 1e-15);
    scene.with_query_and_rotations(turning(spin, 0.0), turning(-spin, apart), expected)
}
