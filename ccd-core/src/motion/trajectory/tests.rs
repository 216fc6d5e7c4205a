//! Compares the deviations of stretches with poses in between.

use super::*;
use crate::math::order::greater;
use crate::tests::scene::{
    RngExt, random_direction, random_point_in_ball, random_power_of_ten, rng,
};
use crate::tests::trajectories::SwingingTrajectory;
use glam::DVec3;

/// Returns the largest sampled deviation in a stretch of points at the distance `reach` from the center, divided by its
/// bound.
fn largest_deviation_share(trajectory: &dyn Trajectory, from: f64, to: f64, reach: f64) -> f64 {
    let stretch = trajectory.stretch_between(from, to).unwrap();
    let bound = stretch.deviation_bound.at_reach(reach);
    let center = stretch.motion.center();
    let mut rng = rng((1e6 * from) as u64);
    let mut worst = 0.0;
    for k in 0..=16 {
        let t = from + (to - from) * f64::from(k) / 16.0;
        let [true_pose, near] = [trajectory.pose(t).unwrap(), stretch.pose(t - from)];
        let x = center + reach * random_direction(&mut rng);
        let off = true_pose.transform_point(x) - near.transform_point(x);
        worst = greater(worst, off.length() / bound);
    }
    worst
}

#[test]
fn smooth_trajectories_stray_by_no_more_than_their_accelerations_allow() {
    let mut rng = rng(1);
    let mut tightest = 0.0;
    for _ in 0..3_000 {
        let swing = SwingingTrajectory::draw(&mut rng, 3.0);
        let from = rng.random_range(0.0..2.0);
        let to = from + random_power_of_ten(&mut rng, -6.0, 0.0);
        let found = largest_deviation_share(&swing, from, to, rng.random_range(0.0..2.0));
        assert!(found <= 1.0, "{found} of {swing:?} from {from} to {to}");
        tightest = greater(tightest, found);
    }
    assert!(tightest > 0.5, "{tightest}");
}

#[test]
fn motions_are_exact_from_the_start_and_off_by_rounding_later() {
    let mut rng = rng(2);
    for _ in 0..2_000 {
        let start = Pose::new(
            random_point_in_ball(&mut rng, 9.0),
            crate::tests::scene::random_rotation(&mut rng),
        );
        let spin = random_power_of_ten(&mut rng, -2.0, 3.0) * random_direction(&mut rng);
        let [velocity, center] = [(); 2].map(|()| random_point_in_ball(&mut rng, 3.0));
        let motion = Motion::about(start.unwrap(), velocity, spin, center).unwrap();
        let whole = motion.stretch_between(0.0, 1.0).unwrap();
        assert_eq!(whole, Stretch::exact(motion));
        let from = rng.random_range(0.0..1.0);
        let later = motion.stretch_between(from, 1.0).unwrap();
        assert!(later.deviation_bound.at_reach(1.0) < 1e-10);
        // The compared poses are rounded, too, by about as much.
        assert!(largest_deviation_share(&motion, from, 1.0, 1.0) <= 2.0);
    }
}

#[test]
fn no_turn_is_no_stray_at_any_reach() {
    assert_eq!(DeviationBound::ZERO.at_reach(f64::INFINITY), 0.0);
    let shifted = DeviationBound {
        center_deviation: 2.0,
        max_deviation_angle: 0.0,
    };
    assert_eq!(shifted.at_reach(f64::INFINITY), 2.0);
    let turned = DeviationBound {
        max_deviation_angle: 0.5,
        ..shifted
    };
    assert_eq!(turned.at_reach(4.0), 4.0);
}

#[test]
fn what_is_no_bound_bounds_nothing() {
    for no_bound in [f64::NAN, -1e-300, -1.0] {
        let turned = DeviationBound {
            center_deviation: 1.0,
            max_deviation_angle: no_bound,
        };
        assert!(turned.at_reach(2.0).is_nan());
    }
}

#[test]
fn trajectories_have_the_poses_of_their_tangents() {
    let mut rng = rng(3);
    let swing = SwingingTrajectory::draw(&mut rng, 3.0);
    for k in 0..10 {
        let t = f64::from(k) / 10.0;
        let [pose, tangent] = [
            swing.pose(t),
            swing.tangent_motion(t).map(|motion| motion.start()),
        ];
        let [pose, tangent] = [pose.unwrap(), tangent.unwrap()];
        assert!(pose.translation().distance(tangent.translation()) < 1e-14);
        assert!(pose.rotation().dot(tangent.rotation()).abs() > 1.0 - 1e-15);
    }
    let _: DVec3 = swing.pose(0.5).unwrap().translation();
}

#[test]
fn deviations_after_times_whose_square_is_zero_are_bounded() {
    let (time, acceleration) = (1e-162, 1e304);
    assert_eq!(time * time, 0.0);
    let stray = AccelerationBounds {
        linear_acceleration: acceleration,
        angular_acceleration: acceleration,
    }
    .deviation_bound_after(time);
    for bound in [stray.center_deviation, stray.max_deviation_angle] {
        assert!((0.5e-20..0.500_001e-20).contains(&bound), "{bound:e}");
    }
}
