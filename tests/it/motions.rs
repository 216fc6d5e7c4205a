//! Motions are as specified: through both poses, with any number of turns, about any centre.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::{Motion, Pose};
use ccd_tests::models::cuboid;
use ccd_tests::query::{Actor, Query};
use ccd_tests::referee::Placement;
use ccd_tests::strategies::{direction, rotation, runner};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn pose() -> impl Strategy<Value = Pose> {
    (direction(), -3.0..3.0f64, rotation())
        .prop_map(|(n, far, rotation)| Pose::new(10.0f64.powf(far) * n, rotation).expect("a pose"))
}

fn apart(x: &Pose, y: &Pose, reach: f64) -> f64 {
    let corner = |pose: &Pose, n: DVec3| pose.transform_point(reach * n);
    let gap = |n: &DVec3| corner(x, *n).distance(corner(y, *n));
    [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z]
        .iter()
        .map(gap)
        .fold(0.0, greater)
}

#[test]
fn between_two_poses_passes_through_both() {
    let inputs = (pose(), pose(), direction(), 1e-3..1e3f64);
    runner(2_000)
        .run(&inputs, |(start, end, centre, duration)| {
            let motion = Motion::between(start, end, centre, duration).expect("finite");
            let size = 1.0 + start.translation().length() + end.translation().length();
            prop_assert!(apart(&motion.pose(0.0), &start, 1.0) <= 1e-13 * size);
            prop_assert!(apart(&motion.pose(duration), &end, 1.0) <= 1e-13 * size);
            prop_assert!(motion.spin().length() * duration <= PI + 1e-12);
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn the_centre_moves_on_a_line_and_the_rest_around_it() {
    let inputs = (
        pose(),
        direction(),
        direction(),
        direction(),
        0.0..50.0f64,
        0.0..1.0f64,
    );
    runner(2_000)
        .run(&inputs, |(start, velocity, axis, centre, turn, t)| {
            let motion = Motion::about(start, velocity, turn * axis, centre).expect("finite");
            let pose = motion.pose(t);
            let size = 2.0 + start.translation().length();
            let line = start.transform_point(centre) + t * velocity;
            prop_assert!(pose.transform_point(centre).distance(line) <= 1e-13 * size);
            let arm =
                |pose: &Pose| pose.transform_point(DVec3::ZERO) - pose.transform_point(centre);
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
        .run(&inputs, |(start_a, start_b, axis, centre, turn, t)| {
            let moving = |start, sign: f64| Actor {
                shape: cube(),
                motion: Motion::about(start, sign * centre, sign * turn * axis, centre)
                    .expect("finite"),
            };
            let query = Query::new(moving(start_a, 1.0), moving(start_b, -1.0));
            let [a, b] = Placement::pair(&query);
            for corner in &query.a.shape.mesh.vertices {
                let seen = b.at(t, *corner) - a.at(t, *corner);
                let [x, y] =
                    [&query.a, &query.b].map(|actor| actor.motion.pose(t).transform_point(*corner));
                prop_assert!(seen.distance(y - x) <= query.rounding());
            }
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn whole_turns_come_back_and_half_turns_do_not() {
    let at = |turn: f64| {
        Motion::new(Pose::IDENTITY, DVec3::ZERO, turn * DVec3::Z)
            .expect("finite")
            .pose(1.0)
    };
    assert!(apart(&at(5.0 * TAU), &Pose::IDENTITY, 1.0) < 1e-13);
    assert!((at(3.0 * PI).transform_point(DVec3::X) + DVec3::X).length() < 1e-13);
    assert!((at(4.5 * TAU + FRAC_PI_2).transform_point(DVec3::X) + DVec3::Y).length() < 1e-13);
}
