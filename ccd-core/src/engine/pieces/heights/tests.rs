//! Compares the bounds for many points at once with the tracks of all points.

mod worst;

use super::*;
use crate::body::Body;
use crate::body::polytope::Polytope;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::settings::Settings;
use crate::tests::scene::{
    Pcg64, RngExt, random_direction, random_point_in_ball, random_power_of_ten, random_rotation,
    rng,
};
use glam::DQuat;

/// Draws 4 to 5,000 points in space, on a sphere, in a plane, or on a line.
fn points(rng: &mut Pcg64, kind: usize, size: f64) -> Vec<DVec3> {
    let count = random_power_of_ten(rng, 0.6, 3.7) as usize;
    let [u, v] = [random_direction(rng), random_direction(rng)];
    let offset = random_direction(rng) * random_power_of_ten(rng, -3.0, 3.0);
    let place = |rng: &mut Pcg64| match kind {
        0 => random_point_in_ball(rng, 1.0),
        1 => random_direction(rng),
        2 => u * rng.random_range(-1.0..1.0) + v * rng.random_range(-1.0..1.0),
        _ => u * rng.random_range(-1.0..1.0),
    };
    (0..count).map(|_| size * (offset + place(rng))).collect()
}

#[test]
fn many_points_are_bounded_like_all_of_them() {
    let mut rng = rng(31);
    let (mut tight, mut many) = ([0; 2], 0);
    for number in 0..600 {
        let size = random_power_of_ten(&mut rng, -6.0, 3.0);
        let polytope = Polytope {
            points: points(&mut rng, number % 4, size),
            ..Polytope::default()
        };
        let body = Body::polytope(polytope).unwrap();
        let spin = random_direction(&mut rng)
            * [0.0, random_power_of_ten(&mut rng, -6.0, 3.0)][number % 2];
        let velocity = random_direction(&mut rng) * random_power_of_ten(&mut rng, -3.0, 2.0) * size;
        let start =
            Pose::new(size * random_direction(&mut rng), random_rotation(&mut rng)).unwrap();
        let motion = Motion::about(
            start,
            velocity,
            spin,
            size * random_point_in_ball(&mut rng, 2.0),
        )
        .unwrap();
        let ball = Body::sphere(0.1).unwrap();
        let (moving, still) = ((&body, motion), (&ball, Motion::STILL));
        let linear_acceleration = random_direction(&mut rng)
            * [0.0, random_power_of_ten(&mut rng, -3.0, 2.0) * size][number / 2 % 2];
        let (bodies, pulls) = ([moving, still], [linear_acceleration, DVec3::ZERO]);
        let problem =
            Problem::with_accelerations(bodies, pulls, 1.0, &Settings::DEFAULT.to_query_settings())
                .unwrap();
        let side = &problem.a;
        let clock = rng.random_range(0.0..1.0);
        let frame = side.path.frame(clock);
        let normal = random_direction(&mut rng);
        let piece = body.piece(0);
        let bare = Piece {
            support_map: None,
            ..piece
        };
        let heights = Heights::new(side, &piece, &frame, normal, clock);
        let twin = Heights::new(side, &bare, &frame, normal, clock);
        many += usize::from(piece.bounding_ball().is_some());
        assert!(heights.speed_bound >= twin.speed_bound * (1.0 - 1e-15));
        // A ball about the points extends no farther than that, except by its own slack.
        assert!(
            heights.speed_bound <= 1.5 * twin.speed_bound,
            "{} {}",
            heights.speed_bound,
            twin.speed_bound
        );
        // The rounding is that of heights about the center, and of the positions from which they are computed.
        let span = problem.a.body.tree().max_distance_from_origin + side.path.center.length();
        let slack = 128.0
            * crate::rounding::UNIT_ROUNDOFF_F64
            * (span + velocity.length() + linear_acceleration.length());
        assert!((heights.least_height - twin.least_height).abs() <= slack);
        for tau in [0.0, 1e-9, 0.01, 0.3, 1.0] {
            let (bound, all) = (heights.bound_all_points(tau), twin.bound_all_points(tau));
            if piece.points.len() <= MAX_TRACKED_POINTS {
                continue;
            }
            assert!(
                bound.height <= all.height + 1e-16 * span,
                "{bound:?} {all:?}"
            );
            assert!(
                bound.rate <= all.rate + 1e-15 * twin.speed_bound,
                "{bound:?} {all:?}"
            );
            assert!(
                bound.second_derivative >= all.second_derivative * (1.0 - 1e-14),
                "{bound:?} {all:?}"
            );
            // Nothing is lost except rounding.
            assert!(
                bound.height >= all.height - 4.0 * slack,
                "{bound:?} {all:?}"
            );
            assert!(bound.rate >= all.rate - 4.0 * slack * (1.0 + side.path.angular_speed));
            let turns = side.path.angular_speed > 0.0;
            tight[usize::from(turns)] +=
                usize::from(bound.second_derivative <= 2.0 * all.second_derivative);
        }
    }
    assert!(many > 200, "{many}");
    assert!(tight.into_iter().all(|count| count > 900), "{tight:?}");
}

/// Compares the heights, rates and second derivatives of few and of many points with those of rotated points.
#[test]
fn points_rise_and_sink_as_their_body_turns() {
    let mut rng = rng(32);
    let ball = Body::sphere(0.1).unwrap();
    let mut many = 0;
    for number in 0..400 {
        let count = [1, 2, 3, 4, 400][number % 5];
        let cloud = Polytope {
            points: (0..count)
                .map(|_| random_point_in_ball(&mut rng, 1.0))
                .collect(),
            ..Polytope::default()
        };
        let body = Body::polytope(cloud).unwrap();
        let spin = random_direction(&mut rng)
            * [0.0, random_power_of_ten(&mut rng, -3.0, 1.0)][number / 5 % 2];
        let start = Pose::new(
            random_point_in_ball(&mut rng, 1.0),
            random_rotation(&mut rng),
        )
        .unwrap();
        let (velocity, center) = (
            random_point_in_ball(&mut rng, 1.0),
            random_point_in_ball(&mut rng, 1.0),
        );
        let motion = Motion::about(start, velocity, spin, center).unwrap();
        let moving = (&body, motion);
        let acceleration = random_point_in_ball(&mut rng, [0.0, 1.0][number / 10 % 2]);
        let (bodies, pulls) = (
            [moving, (&ball, Motion::STILL)],
            [acceleration, DVec3::ZERO],
        );
        let problem =
            Problem::with_accelerations(bodies, pulls, 1.0, &Settings::DEFAULT.to_query_settings())
                .unwrap();
        let side = &problem.a;
        let clock = rng.random_range(0.0..1.0);
        let frame = side.path.frame(clock);
        let (piece, normal) = (body.piece(0), random_direction(&mut rng));
        let twin = ReferenceHeights {
            arms: piece
                .points
                .iter()
                .map(|&x| frame.rotation * (x - side.path.center))
                .collect(),
            normal,
            velocity: velocity + clock * acceleration,
            acceleration,
            spin,
        };
        twin.check_heights(&Heights::new(side, &piece, &frame, normal, clock));
        many += usize::from(piece.bounding_ball().is_some());
    }
    assert!(many > 50, "{many}");
}

/// A reference for [`Heights`], which rotates every point about the center of rotation.
struct ReferenceHeights {
    arms: Vec<DVec3>,
    normal: DVec3,
    velocity: DVec3,
    acceleration: DVec3,
    spin: DVec3,
}

impl ReferenceHeights {
    /// Returns the height of a point, its rate, and the second derivative due to rotation.
    fn point(&self, k: usize, tau: f64) -> PointHeight {
        let arm = DQuat::from_scaled_axis(self.spin * tau) * self.arms[k];
        let turning = self.spin.cross(arm);
        PointHeight {
            height: self.normal.dot(arm) + self.linear_displacement(tau),
            rate: self
                .normal
                .dot(self.velocity + self.acceleration * tau + turning),
            second_derivative: self.normal.dot(self.spin.cross(turning)).abs(),
        }
    }

    /// Returns the displacement of all points along the normal after `tau`, without rotation.
    fn linear_displacement(&self, tau: f64) -> f64 {
        self.normal
            .dot(self.velocity * tau + self.acceleration * (0.5 * tau * tau))
    }

    fn least_point_value(&self, tau: f64, of: impl Fn(&PointHeight) -> f64) -> f64 {
        let each = (0..self.arms.len()).map(|k| of(&self.point(k, tau)));
        each.fold(f64::INFINITY, lesser)
    }

    fn check_heights(&self, heights: &Heights<'_>) {
        let rate = self.spin.length();
        let is = |one: f64, other: f64| (one - other).abs() < 1e-11 * (1.0 + rate * rate);
        assert_eq!(heights.is_nonrotating(), rate == 0.0);
        assert!(is(
            heights.motion_along_axis.linear_rate,
            self.normal.dot(self.velocity)
        ));
        let linear_acceleration = self.normal.dot(self.acceleration);
        assert!(
            is(
                heights.motion_along_axis.linear_acceleration,
                linear_acceleration
            ) && is(
                heights.linear_acceleration_lower_bound(),
                linear_acceleration
            )
        );
        assert!(
            heights.linear_acceleration_lower_bound()
                <= heights.motion_along_axis.linear_acceleration
        );
        assert!(is(
            heights.least_height,
            self.least_point_value(0.0, |p| p.height)
        ));
        let farthest = self.arms.iter().map(|arm| arm.length()).fold(0.0, greater);
        assert!(heights.speed_bound >= (self.velocity.length() + rate * farthest) * (1.0 - 1e-14));
        assert_eq!(
            heights.tracks_if_few_points().is_some(),
            self.arms.len() <= MAX_TRACKED_POINTS
        );
        for tau in [0.0, 0.1, 0.5, 1.0] {
            let bound = heights.bound_all_points(tau);
            assert!(is(bound.height, self.least_point_value(tau, |p| p.height)));
            assert!(is(bound.rate, self.least_point_value(tau, |p| p.rate)));
            assert!(
                -bound.second_derivative
                    <= self.least_point_value(tau, |p| -p.second_derivative) + 1e-12
            );
            let both = |p: &PointHeight| p.height + p.rate;
            let least = heights.min_over_points_lower_bound(tau, both);
            assert!(least <= self.least_point_value(tau, both) + 1e-11 * (1.0 + rate * rate));
            let Some(few) = heights.tracks_if_few_points() else {
                continue;
            };
            assert!(is(least, self.least_point_value(tau, both)));
            for (k, point) in few
                .heights_at(heights.angle_sin_cos(tau), tau)
                .into_iter()
                .enumerate()
            {
                // The last point is repeated.
                let twin = self.point(lesser(k as u32, self.arms.len() as u32 - 1) as usize, tau);
                assert!(is(point.height, twin.height) && is(point.rate, twin.rate));
            }
        }
        self.check_descent(heights, 0.7);
    }

    /// Checks that `max_rotational_descent_until` is not less than the largest sampled descent by rotation, and at most 1e-3 more;
    /// or `None`, if the piece has many points.
    fn check_descent(&self, heights: &Heights<'_>, horizon: f64) {
        let many = heights.piece.bounding_ball().is_some();
        let Some(descent) = heights.max_rotational_descent_until(horizon) else {
            assert!(many);
            return;
        };
        assert!(!many);
        let samples = (0..=1_000).map(|k| horizon * f64::from(k) / 1e3);
        let lowest = samples
            .map(|tau| self.least_point_value(tau, |p| p.height) - self.linear_displacement(tau))
            .fold(f64::INFINITY, lesser);
        let sampled = self.least_point_value(0.0, |p| p.height) - lowest;
        assert!(
            (-1e-12..1e-3).contains(&(descent - sampled)),
            "{descent} {sampled}"
        );
    }
}
