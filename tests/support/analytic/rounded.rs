//! Scenes of rounded pieces without a mesh: balls, capsules and rounded boxes.

use super::{ExpectedOutcome, Scene};
use crate::models::{Mesh, Shape, cuboid};
use crate::query::MovingShape;
use ccd_core::glam::DVec3;
use ccd_core::{Polytope, Solidity};
use std::f64::consts::PI;

pub(super) fn scenes() -> Vec<Scene> {
    vec![
        balls_passing(),
        opposing_balls(),
        ball_on_wall(),
        capsule_on_wall(),
        rounded_box_on_wall(),
    ]
}

/// Returns a solid of one convex part, the hull of some points grown by a radius.
fn rounded_hull(points: Vec<DVec3>, radius: f64) -> Shape {
    Shape {
        mesh: Mesh {
            vertices: Vec::new(),
            faces: Vec::new(),
        },
        parts: vec![Polytope {
            points,
            radius,
            ..Polytope::default()
        }],
        volume: Solidity::Solid,
    }
}

fn ball(radius: f64) -> Shape {
    rounded_hull(vec![DVec3::ZERO], radius)
}

fn wall() -> MovingShape {
    MovingShape::still(
        without_faces(cuboid(DVec3::new(0.5, 4.0, 4.0))),
        2.0 * DVec3::X,
    )
}

fn without_faces(mut shape: Shape) -> Shape {
    shape.mesh.faces.clear();
    shape
}

/// Returns two balls that pass each other at a distance.
fn balls_passing() -> Scene {
    let moving = MovingShape::moving(
        ball(0.5),
        DVec3::new(-2.0, 1.1, 0.0),
        4.0 * DVec3::X,
        PI * DVec3::Z,
    );
    let still = MovingShape::still(ball(0.5), DVec3::ZERO);
    // The least distance, when its center passes at 1.1.
    Scene::new(
        "balls passing",
        [moving, still],
        ExpectedOutcome::Free { gap: 1.1 - 1.0 },
    )
}

/// Returns two balls that move in opposite directions on parallel lines, and meet.
fn opposing_balls() -> Scene {
    let left =
        MovingShape::translating_shape(ball(0.5), DVec3::new(-2.0, 0.6, 0.0), 2.0 * DVec3::X);
    let right = MovingShape::moving(ball(0.5), 2.0 * DVec3::X, -2.0 * DVec3::X, 9.0 * DVec3::Y);
    let time = |g: f64| (4.0 - ((1.0 + g).powi(2) - 0.36).sqrt()) / 4.0;
    Scene::new(
        "balls head-on",
        [left, right],
        ExpectedOutcome::exact_hit(time),
    )
}

/// Returns a rotating ball that flies at a wall.
fn ball_on_wall() -> Scene {
    let falling = MovingShape::moving(ball(0.5), DVec3::ZERO, 2.0 * DVec3::X, 30.0 * DVec3::ONE);
    Scene::new(
        "ball on wall",
        [falling, wall()],
        ExpectedOutcome::exact_hit(|g| (1.0 - g) / 2.0),
    )
}

/// Returns a rotating capsule whose end hits a wall.
fn capsule_on_wall() -> Scene {
    let capsule = rounded_hull(vec![-2.0 * DVec3::Z, 2.0 * DVec3::Z], 0.25);
    let turning = MovingShape::rotating_shape(capsule, DVec3::ZERO, PI * DVec3::Y);
    Scene::new(
        "capsule on wall",
        [turning, wall()],
        ExpectedOutcome::exact_hit(|g| ((1.5 - 0.25 - g) / 2.0_f64).asin() / PI),
    )
}

/// Returns a rounded box that flies at a wall, face first.
fn rounded_box_on_wall() -> Scene {
    let mut shape = without_faces(cuboid(DVec3::splat(0.25)));
    shape.parts[0].radius = 0.125;
    let flying = MovingShape::translating_shape(shape, -DVec3::X, 4.0 * DVec3::X);
    let time = |g: f64| (1.0 + 1.5 - 0.25 - 0.125 - g) / 4.0;
    Scene::new(
        "rounded box",
        [flying, wall()],
        ExpectedOutcome::exact_hit(time),
    )
}
