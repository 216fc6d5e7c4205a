//! Tests that a path has the poses of its motion relative to the origin, at times in units of the duration.

use super::Path;
use crate::math::order::greater;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::rounding::position_rounding;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::scene::{
    RngExt, random_direction, random_point_in_ball, random_power_of_ten, random_rotation, rng,
};
use crate::tests::worst::{RandomCase, WorstCaseSearch, error_fraction};
use glam::{DMat3, DVec3};

#[test]
fn frames_are_the_poses_of_the_motion_less_the_origin() {
    let mut rng = rng(1);
    for _ in 0..2_000 {
        let start = Pose::new(
            random_point_in_ball(&mut rng, 9.0),
            random_rotation(&mut rng),
        )
        .unwrap();
        let turn = match rng.random_range(0..3) {
            0 => 0.0,
            1 => random_power_of_ten(&mut rng, -12.0, -3.0),
            _ => random_power_of_ten(&mut rng, -3.0, 1.6),
        };
        let duration = random_power_of_ten(&mut rng, -3.0, 3.0);
        let motion = Motion::about(
            start,
            random_point_in_ball(&mut rng, 5.0) / duration,
            random_direction(&mut rng) * turn / duration,
            random_point_in_ball(&mut rng, 3.0),
        )
        .unwrap();
        let origin = random_point_in_ball(&mut rng, 9.0);
        let path = Path::new(&motion, origin, duration);
        let point = random_point_in_ball(&mut rng, 3.0);
        for s in [0.0, 0.3, 1.0, rng.random_range(0.0..1.0)] {
            let frame = path.frame(s);
            let truth = motion.pose(s * duration).transform_point(point) - origin;
            let scale = 1e-14 * (10.0 + turn);
            assert!(
                frame.transform_point(point).distance(truth) < scale,
                "{motion:?} at {s}"
            );
            assert!(
                path.center_at(s)
                    .distance(frame.transform_point(motion.center()))
                    < scale
            );
            // The velocity is the limit of displacement over time.
            let step = 1e-6;
            let moved = path.frame(s + step).transform_point(point) - frame.transform_point(point);
            let velocity = path.velocity_at(frame.transform_point(point), s);
            let error = (moved / step).distance(velocity);
            assert!(
                error < 1e-5 * (1.0 + turn * turn) + 1e-7 * (10.0 + turn),
                "{error:e}"
            );
        }
        // Points move at their distance from the axis times the rate, the farthest one the fastest.
        let points = [point, random_point_in_ball(&mut rng, 3.0)];
        let place = |x| path.frame(0.4).transform_point(x);
        let fastest = points.map(|x| path.velocity_at(place(x), 0.4).distance(path.velocity));
        let expected = greater(fastest[0], fastest[1]);
        let found = path.angular_speed * path.max_distance_from_axis(&points);
        assert!(
            (found - expected).abs() <= 1e-13 * (1.0 + turn),
            "{found} {expected}"
        );
        assert_eq!(path.is_turning(), turn > 0.0);
        let spin = path.frame(0.7).rotation * path.local_angular_velocity;
        assert!(spin.distance(path.spin) < 1e-13 * (1.0 + turn));
    }
}

#[test]
fn without_a_turn_the_rotation_does_not_change_by_a_bit() {
    let mut rng = rng(2);
    let start = Pose::new(DVec3::ONE, random_rotation(&mut rng)).unwrap();
    let motion = Motion::new(start, DVec3::X, DVec3::ZERO).unwrap();
    let path = Path::new(&motion, DVec3::ZERO, 1.0);
    assert_eq!(path.frame(0.0).rotation, path.frame(0.9).rotation);
    assert_eq!(path.angular_speed, 0.0);
}

/// Returns the position of a body's point in double-double, from the path's stored coefficients.
fn exact_position(path: &Path, s: DoubleDouble, x: DVec3) -> DoubleDouble3 {
    let arm = DoubleDouble3::from(x) - DoubleDouble3::from(path.center);
    let rotated = |m: &DMat3| {
        let row = |k: usize| DoubleDouble3::from(m.row(k)).dot(arm);
        DoubleDouble3([row(0), row(1), row(2)])
    };
    let (sin, cos) = (DoubleDouble::from(path.angular_speed) * s).sin_cos();
    let turned =
        rotated(&path.cosine_coefficient).scale(cos) + rotated(&path.sine_coefficient).scale(sin);
    let half = DoubleDouble::from(0.5) * s;
    let change =
        DoubleDouble3::from(path.velocity) + DoubleDouble3::from(path.acceleration).scale(half);
    DoubleDouble3::from(path.start_position)
        + change.scale(s)
        + turned
        + rotated(&path.constant_part)
}

/// Tests that positions on a part of a path differ from those on the whole path by at most `position_rounding`, in the
/// worst case that a search finds.
#[test]
fn worst_part() {
    let found = WorstCaseSearch::new("place_rounding, part of a path", 4_000).search(
        |tape: &mut RandomCase| {
            let start =
                Pose::new(tape.vector(-20..=10).map(f64::from), random_rotation(tape)).ok()?;
            let spin = random_direction(tape) * tape.size(-10..=19);
            let center = tape.vector(-20..=4);
            let motion = Motion::about(start, tape.vector(-20..=10), spin, center).ok()?;
            let path = Path::new(&motion, DVec3::ZERO, 1.0);
            let path = path.with_acceleration(tape.vector(-20..=4).into());
            let (from, time, share_of_time) = (
                tape.next_fraction(),
                tape.next_fraction(),
                tape.next_fraction(),
            );
            let to = from + (1.0 - from) * time;
            let arm = DVec3::from(tape.vector(-20..=4));
            let part = path.subpath([from, to]);
            let [begins, ends, share_of_time] = [from, to, share_of_time].map(DoubleDouble::from);
            let s = begins + share_of_time * (ends - begins);
            let x = path.center + arm;
            let error = exact_position(&part, share_of_time, x) - exact_position(&path, s, x);
            let way = path.center_at(0.0).length() + path.speed_bound();
            let allowed = position_rounding(x.distance(path.center), path.angular_speed, way);
            Some(error_fraction(error.length().get(), allowed))
        },
    );
    found.assert_tight_bound(100.0);
}

#[test]
fn parts_of_the_least_rotations_are_rigid() {
    for turn in [5e-324, 1e-320, 1e-200, 0.99e-100, 1.01e-100, 1e-30] {
        let motion = Motion::new(Pose::IDENTITY, DVec3::X, turn * DVec3::Y).unwrap();
        let part = Path::new(&motion, DVec3::ZERO, 1.0).subpath([0.25, 0.25 + 1e-6]);
        let off = part.frame(0.5).rotation - DMat3::IDENTITY;
        assert!(
            off.abs().to_cols_array().iter().all(|x| *x < 1e-15),
            "{turn}: {off}"
        );
        assert_eq!(part.is_turning(), turn > 1e-100, "{turn}");
    }
}
