//! Scenes of bodies that hold each other: hooks, threads, rings, slits.

use super::super::family::{BodyMotion, Family, FamilyScene, truth_for_contact_time};
use super::super::shapes::{
    cuboid, extrude_cells, helicoid, sheet, slit_plate, stacked_squares, torus,
};
use super::{family, negative_powers_of_ten, rod, rod_contact_angle};
use crate::truth::Truth;
use anyhow::Result;
use ccd_core::glam::{DAffine3, DQuat, DVec3, dvec3};
use ccd_core::order::greater;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub(super) fn families() -> Vec<Family> {
    vec![
        family("hooks pulled apart", hooks).with_parameter("slack", negative_powers_of_ten(1..=12)),
        family("ring onto a ring", ring_onto_ring)
            .with_parameter("way to contact", negative_powers_of_ten(1..=12)),
        family("screw in its nut", |turns| screw_in_nut(turns, 0.5))
            .with_parameter("turns", vec![0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0]),
        family("screw with little play", |play| screw_in_nut(1.0, play)).with_parameter(
            "play against pitch",
            vec![0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002],
        ),
        family("sheet between two sheets", sheet_between_sheets)
            .with_parameter("gap", negative_powers_of_ten(1..=12)),
        family("plate through a slit", plate_through_slit)
            .with_parameter("gap", negative_powers_of_ten(1..=12)),
        family("turned frames", rod_in_rotated_frame).with_parameter(
            "degrees",
            vec![0.0, 1.0, 10.0, 30.0, 45.0, 60.0, 80.0, 90.0, 120.0, 180.0],
        ),
    ]
}

/// Makes two interlocked hooks, at right angles to each other, that are pulled apart until their bars meet (case T15).
fn hooks(slack: f64) -> Result<FamilyScene> {
    // A bar from z = 0 to 0.2 with an arm at either end.
    let bar = 0.2;
    let hook = extrude_cells(
        &[-0.5, -0.3, 0.3, 0.5],
        &[0.0, bar, 2.0],
        0.5 * bar,
        |x, z| z == 0 || x != 1,
    )?;
    // Upside down, the other hook's bar is above this one's: its lower side is at 0.2 + slack.
    let holding = BodyMotion::straight((2.0 * bar + slack) * DVec3::Z, DVec3::NEG_Z)
        .with_orientation(DQuat::from_rotation_z(FRAC_PI_2) * DQuat::from_rotation_x(PI));
    let scene = FamilyScene::new(hook.clone(), hook).with_tolerance(greater(0.1 * slack, 1e-11));
    scene.with_query_and_rotations(
        holding,
        BodyMotion::STILL,
        truth_for_contact_time(slack, 1e-14),
    )
}

/// Makes a ring that falls flat onto an equal ring, and meets it all around.
fn ring_onto_ring(way: f64) -> Result<FamilyScene> {
    let (radius, tube) = (1.0, 0.25);
    let falling = BodyMotion::straight((2.0 * tube + way) * DVec3::Z, DVec3::NEG_Z);
    let scene = FamilyScene::new(torus(radius, tube)?, torus(radius, tube)?)
        .with_tolerance(greater(0.1 * way, 1e-11));
    scene.with_query_and_rotations(
        falling,
        BodyMotion::STILL,
        truth_for_contact_time(way, 1e-14),
    )
}

/// The pitch of the threads: their rise per turn.
const PITCH: f64 = 0.2;
/// The inner and outer radii of the threads.
const THREAD_RADII: [f64; 2] = [0.9, 1.0];

/// Makes the flank of a screw that rotates between the flanks of its nut at their common pitch (case T18). `play` is
/// the distance between the flanks, as a fraction of the pitch.
fn screw_in_nut(turns: f64, play: f64) -> Result<FamilyScene> {
    // A facet leaves its flank by a fraction of the pitch of (R − r) / (R + r) / (2 sides) at most, which is 4e-4
    // here: the flanks keep more than half of their play.
    let sides = 64;
    let flank = helicoid(THREAD_RADII, PITCH, sides, 3)?;
    let turning = BodyMotion::straight(play * PITCH * DVec3::Z, turns * PITCH * DVec3::Z)
        .with_spin(TAU * turns * DVec3::Z);
    let scene = FamilyScene::new(flank.clone(), flank).with_tolerance(0.1 * play * PITCH);
    scene.with_query_and_rotations(turning, BodyMotion::STILL, Truth::Free)
}

/// Makes a sheet that slides between two other sheets, at a gap from each.
fn sheet_between_sheets(gap: f64) -> Result<FamilyScene> {
    let sliding = BodyMotion::straight(-3.0 * DVec3::X, 6.0 * DVec3::X);
    with_free_query(
        FamilyScene::new(
            sheet(4)?,
            stacked_squares(&sheet(4)?, [-gap, gap].into_iter())?,
        ),
        gap,
        sliding,
    )
}

/// Makes a tilted plate that moves through a slit, which is wider than the plate's extent across it by a gap (case
/// T16).
fn plate_through_slit(gap: f64) -> Result<FamilyScene> {
    let (long, thin, tilt) = (1.0f64, 0.1, 0.15f64);
    let slit = long * tilt.sin() + thin * tilt.cos() + gap;
    let moving = BodyMotion::straight(-3.0 * DVec3::X, 6.0 * DVec3::X)
        .with_orientation(DQuat::from_rotation_y(tilt));
    with_free_query(
        FamilyScene::new(cuboid(long, 1.0, thin)?, slit_plate(slit)?),
        gap,
        moving,
    )
}

fn with_free_query(scene: FamilyScene, gap: f64, moving: BodyMotion) -> Result<FamilyScene> {
    let scene = scene.with_tolerance(greater(0.25 * gap, 1e-11));
    scene.with_query_and_rotations_if(gap >= 1e-12, moving, BodyMotion::STILL, Truth::Free)
}

/// Makes a rod that rotates into a wall, with its mesh stored in a frame that is rotated by the given angle (case T3).
fn rod_in_rotated_frame(degrees: f64) -> Result<FamilyScene> {
    let wall = 1.2;
    let frame = DQuat::from_axis_angle(dvec3(0.48, 0.6, 0.64), degrees.to_radians());
    let rod = rod()?.transformed(DAffine3::from_quat(frame.inverse()))?;
    let turning = BodyMotion::STILL
        .with_orientation(frame)
        .with_spin(PI * DVec3::Y);
    let scene = FamilyScene::new(rod, cuboid(1.0, 3.0, 3.0)?);
    let expected = truth_for_contact_time(rod_contact_angle(wall) / PI, 1e-14);
    scene.with_query_and_rotations(
        turning,
        BodyMotion::motion_at_rest((wall + 1.0) * DVec3::X),
        expected,
    )
}
