//! Rotations, from very small ones to thousands of turns.

use super::super::family::{BodyMotion, Expected, Family, Step, StepError};
use super::super::shapes::{cube, cuboid, moved, slab};
use super::tens;
use ccd_core::glam::DVec3;
use std::f64::consts::{PI, TAU};

pub(super) fn families() -> Vec<Family> {
    let family = |name, values, make| Family {
        name,
        parameter: "turns",
        values,
        make,
    };
    let mace = Family {
        parameter: "radians",
        ..family(
            "mace",
            vec![2.2, 2.5, 3.0, 4.0, 5.0, 6.0, 10.0, 100.0],
            mace,
        )
    };
    vec![
        mace,
        family("drilling cube", tens(-2..=4), drilling),
        family("rod turning into a wall", tens(0..=4), rod_into_a_wall),
        family("rods turning against each other", tens(0..=4), rods),
    ]
}

/// A cube falls flat onto a slab while it rotates about the vertical.
fn drilling(turns: f64) -> Result<Step, StepError> {
    let falling = BodyMotion {
        spin: TAU * turns * DVec3::Z,
        ..BodyMotion::FALLING
    };
    let step = Step::new(cube()?, slab()?);
    let expected = Expected::at(0.625, 1e-14);
    Ok(step.turned_too(falling, BodyMotion::UNDER, expected)?)
}

/// The half length of a rod.
const LONG: f64 = 2.0;
/// The half thickness of a rod.
const THIN: f64 = 0.05;

/// T4: a rod stands upright, and rotates; its corner meets a wall at 1.2 in the first quarter of a turn.
fn rod_into_a_wall(turns: f64) -> Result<Step, StepError> {
    let wall = 1.2;
    let spin = TAU * turns;
    let angle = (wall / LONG.hypot(THIN)).asin() - THIN.atan2(LONG);
    let turning = BodyMotion {
        spin: spin * DVec3::Y,
        ..BodyMotion::STILL
    };
    let step = Step::new(cuboid(THIN, 0.3, LONG)?, cuboid(1.0, 3.0, 3.0)?);
    let expected = Expected::at(angle / spin, 1e-15);
    Ok(step.turned_too(turning, BodyMotion::rest((wall + 1.0) * DVec3::X), expected)?)
}

/// T9: an arm hangs from its centre of rotation, and swings round to a wall above. At the start its tip moves along the
/// wall, so that a bound on the speeds of that moment finds no approach.
fn mace(spin: f64) -> Result<Step, StepError> {
    let (arm, wall): (f64, f64) = (2.0, 1.0);
    let hanging = moved(&cuboid(THIN, 0.5 * arm, THIN)?, -0.5 * arm * DVec3::Y)?;
    let swinging = BodyMotion {
        spin: spin * DVec3::Z,
        ..BodyMotion::STILL
    };
    let angle = arm.atan2(THIN) + (wall / arm.hypot(THIN)).asin();
    let step = Step::new(hanging, cuboid(3.0, 1.0, 3.0)?);
    let expected = Expected::at(angle / spin, 1e-15);
    Ok(step.turned_too(
        swinging,
        BodyMotion::rest((wall + 1.0) * DVec3::Y),
        expected,
    )?)
}

/// T14: two rods rotate against each other, as mirror images.
fn rods(turns: f64) -> Result<Step, StepError> {
    let (apart, spin) = (3.0, TAU * turns);
    let turning = |spin: f64, x: f64| BodyMotion {
        spin: spin * DVec3::Y,
        ..BodyMotion::rest(x * DVec3::X)
    };
    let angle = (0.5 * apart / LONG.hypot(THIN)).asin() - THIN.atan2(LONG);
    debug_assert!(angle < PI);
    let step = Step::new(cuboid(THIN, 0.3, LONG)?, cuboid(THIN, 0.3, LONG)?);
    let expected = Expected::at(angle / spin, 1e-15);
    Ok(step.turned_too(turning(spin, 0.0), turning(-spin, apart), expected)?)
}
