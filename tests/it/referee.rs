//! Tests the referee, which judges all other answers, against closed forms. `scenes.rs` does so for every scene.

use ccd_core::glam::DVec3;
use ccd_tests::analytic::scenes;
use ccd_tests::models::{Mesh, cuboid};
use ccd_tests::query::{MovingShape, Query};
use ccd_tests::referee::{Finding, Referee, contains};

#[test]
fn the_cuboids_in_the_distance_collide() {
    let scene = scenes()
        .into_iter()
        .find(|scene| scene.name.starts_with("T26"))
        .expect("T26");
    let finding = Referee::new(&scene.query).finding();
    assert!(matches!(finding, Finding::Hit { .. }), "{finding:?}");
}

#[test]
fn distances_of_boxes() {
    let gap = |offset: DVec3| {
        let query = Query::new(
            MovingShape::still(cuboid(DVec3::splat(0.5)), DVec3::ZERO),
            MovingShape::still(cuboid(DVec3::splat(0.5)), offset),
        );
        Referee::new(&query).gap(0.0)
    };
    let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-14, "{x} is not {y}");
    close(gap(3.0 * DVec3::X), 2.0);
    close(gap(DVec3::new(2.0, 2.0, 0.3)), 2.0_f64.sqrt());
    close(gap(DVec3::splat(2.0)), 3.0_f64.sqrt());
    close(gap(DVec3::new(0.7, 0.1, 0.2)), 0.0);
}

#[test]
fn winding_separates_inside_from_outside() {
    let Mesh { vertices, .. } = cuboid(DVec3::ONE).mesh;
    let mesh = cuboid(DVec3::ONE).mesh;
    for (p, inside) in [
        (DVec3::ZERO, true),
        (0.99 * DVec3::ONE, true),
        (1.01 * DVec3::X, false),
    ] {
        assert_eq!(contains(&mesh, &vertices, p), inside, "{p}");
    }
}
