//! Tests that bodies proven apart by balls or boxes keep the proven gap at sampled times, and that two spheres are
//! proven apart exactly if they are.

use super::{balls_keep_apart, boxes_keep_apart};
use crate::body::Body;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::settings::Settings;
use crate::tests::scene::{
    MotionThroughPose, RngExt, SoupKind, body, distance, random_direction, random_point_in_ball,
    random_power_of_ten, random_rotation, random_triangle_soup, rng,
};
use glam::DVec3;

#[test]
fn bodies_told_apart_by_balls_keep_their_gap_at_all_sampled_times() {
    assert_bodies_proven_apart_keep_gap(balls_keep_apart);
}

#[test]
fn bodies_told_apart_by_boxes_keep_their_gap_at_all_sampled_times() {
    assert_bodies_proven_apart_keep_gap(boxes_keep_apart);
}

fn assert_bodies_proven_apart_keep_gap(tells: fn(&Problem<'_>) -> bool) {
    let mut rng = rng(1);
    let (mut told, mut near) = (0, 0);
    for _ in 0..2_000 {
        let (count, size) = (
            rng.random_range(1..6),
            random_power_of_ten(&mut rng, -2.0, 1.0),
        );
        let bodies = [0, 1].map(|_| {
            body(&random_triangle_soup(
                &mut rng,
                SoupKind::WellShaped,
                count,
                size,
            ))
        });
        let turn = random_power_of_ten(&mut rng, -3.0, 1.5);
        let motions = [0, 1].map(|_| {
            let passage = MotionThroughPose {
                clock: rng.random_range(0.0..1.0),
                rotation: random_rotation(&mut rng),
                place: random_point_in_ball(&mut rng, 6.0 * size),
                middle: random_point_in_ball(&mut rng, size),
                velocity: random_point_in_ball(&mut rng, 3.0),
                spin: random_direction(&mut rng) * if rng.random_bool(0.3) { 0.0 } else { turn },
                center: random_point_in_ball(&mut rng, 2.0 * size),
            };
            passage.motion()
        });
        let [a, b] = [(&bodies[0], motions[0]), (&bodies[1], motions[1])];
        let pulls = [0, 1].map(|_| {
            if rng.random_bool(0.5) {
                random_point_in_ball(&mut rng, 20.0)
            } else {
                DVec3::ZERO
            }
        });
        let bodies = [a, b];
        let problem =
            Problem::with_accelerations(bodies, pulls, 1.0, &Settings::DEFAULT.to_query_settings())
                .unwrap();
        if !tells(&problem) {
            near += 1;
            continue;
        }
        told += 1;
        for s in (0..=64).map(|k| f64::from(k) / 64.0) {
            assert!(distance(&problem, s) > problem.contact_distance());
        }
    }
    assert!(told > 200 && near > 200, "{told} {near}");
}

#[test]
fn balls_are_told_apart_up_to_the_gap() {
    let mut rng = rng(2);
    for _ in 0..1_000 {
        let radii = [0, 1].map(|_| random_power_of_ten(&mut rng, -3.0, 1.0));
        let balls = radii.map(|radius| Body::sphere(radius).unwrap());
        let config = Settings {
            margin: random_power_of_ten(&mut rng, -6.0, 0.0),
            tolerance: 1e-6,
            ..Settings::DEFAULT
        };
        let nearest = random_direction(&mut rng);
        let along = nearest.any_orthonormal_vector() * random_power_of_ten(&mut rng, -3.0, 2.0);
        // The balls are nearest at the start, within the duration, at its end, or always.
        let (before, after) =
            [(0.0, 1.0), (0.3, 0.7), (1.0, 0.0), (0.0, 0.0)][rng.random_range(0..4)];
        let gap = radii[0] + radii[1] + config.margin + config.tolerance;
        for (excess, expected) in [(-0.5, false), (0.5, true)] {
            // The radii of balls are rounded outward in f32.
            let rounded = 1e-6 * gap + config.tolerance;
            let place = nearest * (gap + excess * 4.0 * rounded);
            let pose = Pose::at(place - along * before).unwrap();
            let motion = Motion::new(pose, along * (before + after), DVec3::ZERO).unwrap();
            let problem = Problem::of_moving_bodies(
                (&balls[0], motion),
                (&balls[1], Motion::STILL),
                1.0,
                &config,
            );
            assert_eq!(balls_keep_apart(&problem.unwrap()), expected);
        }
    }
}
