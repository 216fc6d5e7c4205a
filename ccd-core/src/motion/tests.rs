//! Tests that motions pass through the poses from which they are created.

use super::Motion;
use super::pose::Pose;
use crate::error::InputError;
use crate::math::order::greater;
use crate::tests::scene::{
    RngExt, random_direction, random_point_in_ball, random_power_of_ten, random_rotation, rng,
};
use glam::{DQuat, DVec3};
use std::f64::consts::PI;

/// Returns the largest distance between the images of points of about unit size under two poses.
fn pose_distance(a: &Pose, b: &Pose) -> f64 {
    let points = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let off = points.map(|p| a.transform_point(p).distance(b.transform_point(p)));
    off.into_iter().fold(0.0, greater)
}

#[test]
fn between_passes_through_both_poses_and_never_turns_more_than_half() {
    let mut rng = rng(1);
    for _ in 0..2_000 {
        let poses = [(); 2].map(|()| {
            Pose::new(
                random_point_in_ball(&mut rng, 9.0),
                random_rotation(&mut rng),
            )
            .unwrap()
        });
        let center = random_point_in_ball(&mut rng, 3.0);
        let duration = random_power_of_ten(&mut rng, -3.0, 3.0);
        let motion = Motion::between(poses[0], poses[1], center, duration).unwrap();
        assert!(pose_distance(&motion.pose(0.0), &poses[0]) < 1e-13);
        assert!(pose_distance(&motion.pose(duration), &poses[1]) < 1e-13);
        assert!(motion.angular_velocity().length() * duration <= PI * (1.0 + 1e-15));
        // The center moves on a straight line.
        let half = motion.pose(0.5 * duration).transform_point(center);
        let ends = poses.map(|pose| pose.transform_point(center));
        assert!(half.distance(0.5 * (ends[0] + ends[1])) < 1e-13);
    }
}

#[test]
fn half_turns_and_tiny_turns_keep_their_digits() {
    let mut rng = rng(2);
    for _ in 0..500 {
        let (axis, start) = (random_direction(&mut rng), random_rotation(&mut rng));
        for angle in [PI, PI - 1e-9, PI - 1e-3, 1e-3, 1e-8, 1e-15] {
            let turn = DQuat::from_scaled_axis(axis * angle);
            let poses = [start, turn * start].map(|q| Pose::new(DVec3::ZERO, q).unwrap());
            let motion = Motion::between(poses[0], poses[1], DVec3::ZERO, 1.0).unwrap();
            assert!(
                pose_distance(&motion.pose(1.0), &poses[1]) < 1e-14,
                "{angle}"
            );
            // The error of the turn is about the rounding of a unit quaternion, 2e-16.
            assert!(
                (motion.angular_velocity().length() - angle).abs() < 2e-15,
                "{angle}"
            );
        }
        let pose = Pose::new(DVec3::ONE, start).unwrap();
        let still = Motion::between(pose, pose, DVec3::X, 1.0).unwrap();
        assert!(still.angular_velocity().length() < 1e-15);
    }
}

/// Tests that the signs of the quaternions decide the direction of half a turn, for which both directions are equally
/// short.
#[test]
fn half_a_turn_goes_about_the_axis_as_it_is_given() {
    let turn = |start: DQuat, end: DQuat| {
        let [start, end] = [start, end].map(|q| Pose::new(DVec3::ZERO, q).unwrap());
        let motion = Motion::between(start, end, DVec3::ZERO, 1.0);
        motion.unwrap().angular_velocity()
    };
    for axis in [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X] {
        let half = DQuat::from_xyzw(axis.x, axis.y, axis.z, 0.0);
        let one = DQuat::IDENTITY;
        assert_eq!(turn(one, half), PI * axis);
        assert_eq!(turn(one, -half), -PI * axis);
        assert_eq!(turn(-one, half), -PI * axis);
    }
}

#[test]
fn any_number_of_turns_is_a_motion() {
    let spin = 2.0 * PI * 6.0 * DVec3::Y;
    let motion = Motion::about(Pose::IDENTITY, DVec3::X, spin, DVec3::Z).unwrap();
    let end = Pose::at(DVec3::X).unwrap();
    assert!(pose_distance(&motion.pose(1.0), &end) < 1e-13);
    assert!(pose_distance(&motion.pose(0.5), &Pose::at(0.5 * DVec3::X).unwrap()) < 1e-13);
    // The orientation after another quarter of a turn is different.
    assert!(pose_distance(&motion.pose(1.0 / 24.0), &end) > 1.0);
}

#[test]
fn a_body_at_rest_stays() {
    let mut rng = rng(3);
    let pose = Pose::new(
        random_point_in_ball(&mut rng, 5.0),
        random_rotation(&mut rng),
    )
    .unwrap();
    let motion = Motion::still(pose);
    for t in [0.0, 1.0, 1e9] {
        assert_eq!(motion.pose(t), pose);
    }
}

#[test]
fn motions_that_are_not_finite_are_refused() {
    let mut rng = rng(4);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut vector = random_point_in_ball(&mut rng, 1.0);
        vector[rng.random_range(0..3)] = bad;
        let none = DVec3::ZERO;
        for (what, velocity, spin, center) in [
            ("velocity", vector, none, none),
            ("angular velocity", none, vector, none),
            ("center", none, none, vector),
        ] {
            let made = Motion::about(Pose::IDENTITY, velocity, spin, center);
            assert_eq!(made, Err(InputError::NotFinite { quantity: what }));
        }
        let between = Motion::between(Pose::IDENTITY, Pose::IDENTITY, none, bad);
        assert!(matches!(
            between,
            Err(InputError::OutOfRange {
                quantity: "duration",
                ..
            })
        ));
    }
    let zero = Motion::between(Pose::IDENTITY, Pose::IDENTITY, DVec3::ZERO, 0.0);
    assert!(matches!(
        zero,
        Err(InputError::OutOfRange {
            quantity: "duration",
            ..
        })
    ));
    let far = Pose::at(DVec3::X).unwrap();
    let overflow = Motion::between(Pose::IDENTITY, far, DVec3::ZERO, 1e-320);
    assert_eq!(
        overflow,
        Err(InputError::NotFinite {
            quantity: "velocity"
        })
    );
}
