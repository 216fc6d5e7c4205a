//! Scenes whose sizes, distances and units are far from 1.

use super::super::family::{BodyMotion, Family, FamilyScene, truth_for_contact_time};
use super::super::shapes::{cone, cube, cuboid, slab};
use super::{fall_onto_slab, family, negative_powers_of_ten, powers_of_ten};
use crate::truth::Truth;
use anyhow::Result;
use ccd_core::glam::{DQuat, DVec3, dvec3};
use ccd_core::order::greater;

pub(super) fn families() -> Vec<Family> {
    let sizes = |exponents: std::ops::RangeInclusive<i32>| {
        exponents
            .flat_map(|k| [10f64.powi(k), 10f64.powi(-k)])
            .collect()
    };
    vec![
        family("small against large", cubes_of_unequal_size)
            .with_parameter("size against size", sizes(1..=9)),
        family("unit of length", scene_in_length_unit)
            .with_parameter("size of the scene", sizes(2..=9)),
        family("far from the origin", cubes_far_from_origin)
            .with_parameter("distance in sizes", powers_of_ten(0..=12)),
        family("slender triangles", thin_box_onto_slab)
            .with_parameter("length against width", powers_of_ten(0..=12)),
        family("bullet and paper", bullet_and_paper)
            .with_parameter("way against thickness", powers_of_ten(0..=9)),
        family("margin", cube_within_margin_of_slab)
            .with_parameter("margin against size", margin_parameter_values()),
        family("one inside the other", cube_inside_cube)
            .with_parameter("size against size", negative_powers_of_ten(0..=9)),
        family("unit of time", scene_in_time_unit).with_parameter("duration", sizes(1..=9)),
        family("moving together", cube_onto_moving_cube)
            .with_parameter("common travel", powers_of_ten(0..=9)),
        family("far center of rotation", cube_about_far_center)
            .with_parameter("distance in sizes", powers_of_ten(0..=9)),
        family("needle tip first", needle_onto_slab)
            .with_parameter("width", negative_powers_of_ten(0..=12)),
    ]
}

fn margin_parameter_values() -> Vec<f64> {
    let mut margins = negative_powers_of_ten(-2..=6);
    margins.sort_by(f64::total_cmp);
    margins.insert(0, 0.0);
    margins
}

/// Makes a cube that falls onto a larger or smaller cube, and reaches it at half the duration.
fn cubes_of_unequal_size(size: f64) -> Result<FamilyScene> {
    let way = greater(size, 1.0);
    let falling = BodyMotion::straight((1.0 + size + way) * DVec3::Z, -2.0 * way * DVec3::Z);
    let scene = FamilyScene::new(cuboid(size, size, size)?, cuboid(1.0, 1.0, 1.0)?)
        .with_tolerance(1e-6 * way);
    scene.with_query_and_rotations(
        falling,
        BodyMotion::STILL,
        truth_for_contact_time(0.5, 1e-14),
    )
}

/// Makes a cube that falls onto a slab, with all lengths multiplied by `size`. The scene is like T1 of
/// `tests/it/scenes.rs`.
fn scene_in_length_unit(size: f64) -> Result<FamilyScene> {
    let falling = BodyMotion::straight(3.0 * size * DVec3::Z, -4.0 * size * DVec3::Z);
    let half = 0.5 * size;
    let scene = FamilyScene::new(
        cuboid(half, half, half)?,
        cuboid(9.0 * size, 9.0 * size, size)?,
    )
    .with_tolerance(1e-6 * size);
    let slab = BodyMotion::motion_at_rest(-size * DVec3::Z);
    scene.with_query_and_rotations(falling, slab, truth_for_contact_time(0.625, 1e-14))
}

/// Makes a cube that falls onto a slab within the given duration. The scene is like T1 of `tests/it/scenes.rs`.
fn scene_in_time_unit(duration: f64) -> Result<FamilyScene> {
    let falling = BodyMotion::FALLING;
    let scene = FamilyScene::new(cube()?, slab()?);
    let scene = FamilyScene { duration, ..scene };
    let slab = BodyMotion::RESTING_SLAB_MOTION;
    scene.with_query_and_rotations(falling, slab, truth_for_contact_time(0.625, 1e-14))
}

/// Makes a cube that falls onto another cube while both move sideways by `travel`.
fn cube_onto_moving_cube(travel: f64) -> Result<FamilyScene> {
    let falling = BodyMotion::straight(3.0 * DVec3::Z, dvec3(travel, 0.0, -4.0));
    let fleeing = BodyMotion::straight(DVec3::ZERO, travel * DVec3::X);
    let scene = FamilyScene::new(cube()?, cube()?);
    scene.with_query(falling, fleeing, truth_for_contact_time(0.5, 1e-14))
}

/// Makes a cube that rotates about a center far below it, so that it moves towards a wall nearly in a straight line.
fn cube_about_far_center(distance: f64) -> Result<FamilyScene> {
    let spin = 1.0 / distance;
    let turning = BodyMotion {
        angular_velocity: spin * DVec3::Y,
        rotation_center: -distance * DVec3::Z,
        ..BodyMotion::STILL
    };
    // Its upper corner is the first at the wall, which is at x = 1.
    let (across, up) = (0.5f64, distance + 0.5);
    let angle = (1.0 / up.hypot(across)).asin() - across.atan2(up);
    let scene = FamilyScene::new(cube()?, cuboid(1.0, 3.0, 3.0)?);
    let expected = truth_for_contact_time(angle / spin, 1e-14);
    scene.with_query(
        turning,
        BodyMotion::motion_at_rest(2.0 * DVec3::X),
        expected,
    )
}

/// Makes a cone that falls onto a slab with its tip first; the sides of the cone are long and thin triangles.
fn needle_onto_slab(width: f64) -> Result<FamilyScene> {
    let falling = BodyMotion::straight(2.5 * DVec3::Z, -4.0 * DVec3::Z);
    fall_onto_slab(cone(8, 0.5 * width)?, falling, 0.625)
}

/// Makes a cube that falls onto another cube, both at coordinates of about `distance` in the world frame.
fn cubes_far_from_origin(distance: f64) -> Result<FamilyScene> {
    // All coordinates stay within the distance.
    let origin = distance * dvec3(1.0, -1.0, -1.0);
    let falling = BodyMotion::straight(origin + 3.0 * DVec3::Z, -4.0 * DVec3::Z);
    let scene = FamilyScene::new(cube()?, cube()?);
    scene.with_query(
        falling,
        BodyMotion::motion_at_rest(origin),
        truth_for_contact_time(0.5, 1e-14),
    )
}

/// Makes a long and thin box that falls onto a slab; the sides of the box are long and thin triangles.
fn thin_box_onto_slab(ratio: f64) -> Result<FamilyScene> {
    let thin = 1.0 / ratio;
    let (sin, cos) = 0.3f64.sin_cos();
    let falling = BodyMotion::FALLING.with_orientation(DQuat::from_rotation_x(0.3));
    let reach = thin * (sin + cos);
    fall_onto_slab(cuboid(1.0, thin, thin)?, falling, (3.0 - reach) / 4.0)
}

/// Makes a small cube that moves by distance 1, and hits a thin plate at half of that distance. The scene is like T13
/// of `tests/it/scenes.rs`.
fn bullet_and_paper(ratio: f64) -> Result<FamilyScene> {
    let (bullet, half) = (0.005, 0.05 / ratio);
    let flying = BodyMotion::straight(DVec3::ZERO, DVec3::X);
    let paper = BodyMotion::motion_at_rest(0.5 * DVec3::X);
    let scene = FamilyScene::new(cuboid(bullet, bullet, bullet)?, cuboid(half, 0.5, 0.5)?);
    let expected = truth_for_contact_time(0.5 - half - bullet, 1e-14);
    scene.with_query_and_rotations(flying, paper, expected)
}

/// Makes a cube that falls towards a slab, and is at the distance `margin` from it at half the duration.
fn cube_within_margin_of_slab(margin: f64) -> Result<FamilyScene> {
    let speed = 4.0 * greater(1.0, margin);
    let height = 0.5 + margin + 0.5 * speed;
    let falling = BodyMotion::straight(height * DVec3::Z, -speed * DVec3::Z);
    let scene = FamilyScene::new(cube()?, slab()?);
    let scene = FamilyScene { margin, ..scene };
    let slab = BodyMotion::RESTING_SLAB_MOTION;
    scene.with_query_and_rotations(falling, slab, truth_for_contact_time(0.5, 1e-14))
}

/// Makes a small cube that moves inside a larger cube, so that the solids overlap but their surfaces do not meet. The
/// scene is like T24 of `tests/it/scenes.rs`.
fn cube_inside_cube(size: f64) -> Result<FamilyScene> {
    let half = 0.9 * size;
    let scene = FamilyScene::new(cuboid(half, half, half)?, cuboid(1.0, 1.0, 1.0)?);
    let moving = BodyMotion::straight(DVec3::ZERO, 0.05 * DVec3::X);
    scene.with_query_and_rotations(moving, BodyMotion::STILL, Truth::ContactAtStart)
}
