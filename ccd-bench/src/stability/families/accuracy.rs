//! Scenes whose contact depends on the last digits, because parts are nearly parallel or hardly overlap.

use super::super::family::{BodyMotion, Family, FamilyScene, truth_for_contact_time};
use super::super::shapes::{cube, cuboid, holed_plate, slab, torus};
use super::{ROD_HALF_SIDES, fall_onto_slab, family, negative_powers_of_ten, rod_beside_wall};
use anyhow::Result;
use ccd_core::glam::{DQuat, DVec3, dvec3};
use ccd_core::order::greater;
use std::f64::consts::{FRAC_PI_4, PI, SQRT_2};

pub(super) fn families() -> Vec<Family> {
    vec![
        family("face onto face", face_onto_face)
            .with_parameter("angle to parallel", negative_powers_of_ten(1..=15)),
        family("edge across edge", edge_across_edge)
            .with_parameter("angle to parallel", negative_powers_of_ten(1..=15)),
        family("flat approach", cube_at_grazing_angle)
            .with_parameter("angle to the face", negative_powers_of_ten(1..=12)),
        family("cubes that hardly meet", barely_overlapping_cubes)
            .with_parameter("overlap", negative_powers_of_ten(1..=15)),
        family("rod that hardly reaches", rod_barely_reaching_wall)
            .with_parameter("fraction of its reach", negative_powers_of_ten(1..=12)),
        family("linked rings", linked_rings)
            .with_parameter("way to contact", negative_powers_of_ten(1..=12)),
        family("corner onto face", corner_onto_face)
            .with_parameter("angle to its diagonal", negative_powers_of_ten(1..=15)),
        family("peg turning in a hole", peg_in_a_hole)
            .with_parameter("clearance", negative_powers_of_ten(1..=12)),
        family("hardly turning", slightly_rotating_cube)
            .with_parameter("radians", negative_powers_of_ten(1..=15)),
    ]
}

/// The error of contact times computed from coordinates of a few units, at speeds of at least 1.
const MAX_CONTACT_TIME_ERROR: f64 = 1e-14;

/// Makes a cube that falls onto a slab, with its lower face tilted by a small angle (case T1).
fn face_onto_face(angle: f64) -> Result<FamilyScene> {
    let reach = 0.5 * (angle.sin() + angle.cos());
    let falling = BodyMotion::FALLING.with_orientation(DQuat::from_rotation_y(angle));
    fall_onto_slab(cube()?, falling, (3.0 - reach) / 4.0)
}

/// Makes a rod that falls onto another rod, edge onto edge, at a small angle (case T8).
fn edge_across_edge(angle: f64) -> Result<FamilyScene> {
    let on_edge = DQuat::from_rotation_x(FRAC_PI_4);
    let falling = BodyMotion::FALLING.with_orientation(DQuat::from_rotation_z(angle) * on_edge);
    let lying = BodyMotion::STILL.with_orientation(on_edge);
    let expected = truth_for_contact_time((3.0 - 0.2 * SQRT_2) / 4.0, MAX_CONTACT_TIME_ERROR);
    let scene = FamilyScene::new(cuboid(2.0, 0.1, 0.1)?, cuboid(2.0, 0.1, 0.1)?);
    scene.with_query_and_rotations(falling, lying, expected)
}

/// Makes a cube that falls onto a slab corner first, with its diagonal tilted by a small angle from upright (case T8).
fn corner_onto_face(angle: f64) -> Result<FamilyScene> {
    let upright = DQuat::from_rotation_arc(DVec3::ONE.normalize(), DVec3::Z);
    let turned = DQuat::from_rotation_x(angle) * upright;
    let falling = BodyMotion::FALLING.with_orientation(turned);
    let reach = 0.5 * (turned.inverse() * DVec3::Z).abs().element_sum();
    fall_onto_slab(cube()?, falling, (3.0 - reach) / 4.0)
}

/// Makes a square peg that rotates in a slightly wider square hole, until all four corners meet the hole at once (case
/// T12).
fn peg_in_a_hole(clearance: f64) -> Result<FamilyScene> {
    let half = 0.5;
    let hole = half + clearance;
    let angle = (hole / (half * SQRT_2)).asin() - FRAC_PI_4;
    let turning = BodyMotion::STILL.with_spin(2.0 * angle * DVec3::Z);
    let scene = FamilyScene::new(cuboid(half, half, 1.0)?, holed_plate(hole)?)
        .with_tolerance(greater(0.1 * clearance, 1e-11));
    // The angle has the error of the clearance.
    let expected = truth_for_contact_time(0.5, 1e-15 / clearance);
    scene.with_query_and_rotations(turning, BodyMotion::STILL, expected)
}

/// Makes a cube that falls flat onto a slab while it rotates by a very small angle (case T25).
fn slightly_rotating_cube(turn: f64) -> Result<FamilyScene> {
    let falling = BodyMotion::FALLING.with_spin(turn * DVec3::Y);
    // The lowest corner is lower by the rotation so far: each round adds a digit.
    let mut time = 0.625;
    for _ in 0..40 {
        let (sin, cos) = (turn * time).sin_cos();
        time = (3.0 - 0.5 * (sin + cos)) / 4.0;
    }
    fall_onto_slab(cube()?, falling, time)
}

/// Makes a cube that flies down to a slab at a small angle, and meets it halfway through its flight.
fn cube_at_grazing_angle(angle: f64) -> Result<FamilyScene> {
    let (sin, cos) = angle.sin_cos();
    let height = 2.0 * sin;
    let flying = BodyMotion::straight(dvec3(-2.0, 0.0, 0.5 + height), 4.0 * dvec3(cos, 0.0, -sin));
    // The height is rounded in units of the cube, and the cube descends slowly.
    let expected = truth_for_contact_time(0.5, 1e-15 / sin);
    let scene = FamilyScene::new(cube()?, slab()?).with_tolerance(greater(1e-3 * height, 1e-11));
    scene.with_query_and_rotations(flying, BodyMotion::RESTING_SLAB_MOTION, expected)
}

fn barely_overlapping_cubes(overlap: f64) -> Result<FamilyScene> {
    let flying = BodyMotion::straight(dvec3(-3.0, 0.0, 1.0 - overlap), 6.0 * DVec3::X);
    let expected = truth_for_contact_time(1.0 / 3.0, MAX_CONTACT_TIME_ERROR);
    let scene = FamilyScene::new(cube()?, cube()?);
    scene.with_query_and_rotations_if(overlap > 1e-12, flying, BodyMotion::STILL, expected)
}

/// Makes a rod that rotates until its corner barely reaches a wall, shortly before the corner would pass it (case T5).
fn rod_barely_reaching_wall(fraction: f64) -> Result<FamilyScene> {
    let (long, thin) = ROD_HALF_SIDES;
    let wall = long.hypot(thin) * (1.0 - fraction);
    let turning = BodyMotion::STILL.with_spin(PI * DVec3::Y);
    let time = ((1.0 - fraction).asin() - thin.atan2(long)) / PI;
    // The corner moves along the wall: its distance grows with the square of the time.
    let expected = truth_for_contact_time(time, 1e-15 / fraction.sqrt());
    rod_beside_wall(turning, wall, expected)
}

/// Makes two linked rings, one of which moves a small distance until they touch (case T17).
fn linked_rings(way: f64) -> Result<FamilyScene> {
    let (radius, tube) = (1.0, 0.25);
    // At the start the rings are each in the middle of the other's hole; then one moves until their inner
    // rims are a small way apart.
    let rim = radius - 2.0 * tube;
    let upright = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let hanging =
        BodyMotion::straight((radius + rim - way) * DVec3::X, DVec3::X).with_orientation(upright);
    let scene = FamilyScene::new(torus(radius, tube)?, torus(radius, tube)?)
        .with_tolerance(greater(0.1 * way, 1e-11));
    let expected = truth_for_contact_time(way, MAX_CONTACT_TIME_ERROR);
    scene.with_query(hanging, BodyMotion::STILL, expected)
}
