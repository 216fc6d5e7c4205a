//! Tests that the engine and the referee move bodies as specified, about any center.
//!
//! The tests of `ccd-core` have motions through two poses, and of several turns.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Motion, Pose};
use ccd_tests::models::cuboid;
use ccd_tests::query::{MovingShape, Query};
use ccd_tests::referee::RelativeMotion;
use ccd_tests::strategies::{direction, rotation, runner};
use proptest::prelude::*;

fn pose() -> impl Strategy<Value = Pose> {
    (direction(), -3.0..3.0f64, rotation())
        .prop_map(|(n, far, rotation)| Pose::new(10.0f64.powf(far) * n, rotation).expect("a pose"))
}

#[test]
fn the_center_moves_on_a_line_and_the_rest_around_it() {
    let inputs = (
        pose(),
        direction(),
        direction(),
        direction(),
        0.0..50.0f64,
        0.0..1.0f64,
    );
    runner(2_000)
        .run(&inputs, |(start, velocity, axis, center, turn, t)| {
            let motion = Motion::about(start, velocity, turn * axis, center).expect("finite");
            let pose = motion.pose(t);
            let size = 2.0 + start.translation().length();
            let line = start.transform_point(center) + t * velocity;
            prop_assert!(pose.transform_point(center).distance(line) <= 1e-13 * size);
            let arm =
                |pose: &Pose| pose.transform_point(DVec3::ZERO) - pose.transform_point(center);
            let turned = DQuat::from_axis_angle(axis, turn * t) * arm(&start);
            prop_assert!(arm(&pose).distance(turned) <= 1e-12 * size);
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn the_referee_moves_bodies_as_the_engine_does() {
    let inputs = (
        pose(),
        pose(),
        direction(),
        direction(),
        0.0..20.0f64,
        0.0..1.0f64,
    );
    let cube = || cuboid(DVec3::splat(0.5));
    runner(1_000)
        .run(&inputs, |(start_a, start_b, axis, center, turn, t)| {
            let moving = |start, sign: f64| MovingShape {
                shape: cube(),
                motion: Motion::about(start, sign * center, sign * turn * axis, center)
                    .expect("finite"),
            };
            let query = Query::new(moving(start_a, 1.0), moving(start_b, -1.0));
            let [a, b] = RelativeMotion::pair(&query);
            for corner in &query.a.shape.mesh.vertices {
                let seen = b.point_position_at(t, *corner) - a.point_position_at(t, *corner);
                let [x, y] =
                    [&query.a, &query.b].map(|actor| actor.motion.pose(t).transform_point(*corner));
                prop_assert!(seen.distance(y - x) <= query.rounding());
            }
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
}
