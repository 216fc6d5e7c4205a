//! Tests large times and coordinates, ends of trajectories, and axes of any length.

use super::*;

/// Checks that a trajectory deviates from random stretches between two times by no more than their bounds.
fn check_deviation_between(
    name: &str,
    trajectory: &impl Trajectory,
    from: f64,
    to: f64,
    rng: &mut Rng,
) {
    for _ in 0..1_000 {
        let [a, b] = [(); 2].map(|()| rng.random_range(from..to));
        let (a, b) = if a < b { (a, b) } else { (b, a) };
        let stretch = trajectory.stretch_between(a, b).unwrap();
        assert!(
            stretch.deviation_bound.center_deviation >= 0.0
                && stretch.deviation_bound.max_deviation_angle >= 0.0,
            "{name}"
        );
        let time = rng.random_range(a..=b);
        let exact = trajectory.stretch_between(time, time).unwrap();
        let allowed = stretch.deviation_bound + exact.deviation_bound;
        let near = stretch.pose(time - a);
        let there = exact.motion.start();
        let center = stretch.motion.center();
        let shift = near
            .transform_point(center)
            .distance(there.transform_point(center));
        let turned = near.rotation().conjugate() * there.rotation();
        let turn = 2.0 * turned.xyz().length().atan2(turned.w.abs());
        assert!(
            shift <= allowed.center_deviation,
            "{name}: {shift:e} {allowed:?}"
        );
        assert!(
            turn <= allowed.max_deviation_angle,
            "{name}: {turn:e} {allowed:?}"
        );
    }
}

#[test]
fn times_may_be_far_from_0() {
    let mut rng = Rng::seed_from_u64(5);
    let epoch = 1.7e9;
    for _ in 0..20 {
        let mut at = random_orientation(&mut rng);
        let mut key = |k: usize| {
            at = DQuat::from_scaled_axis(random_vector(&mut rng, 0.5)) * at;
            (epoch + 0.01 * k as f64, at.to_array())
        };
        let keys: Vec<_> = (0..50).map(&mut key).collect();
        let point = Curve::bezier(&[[0.0; 3]], 2.0).unwrap();
        let slerp = Spline::new(point, OrientationCurve::piecewise_slerp(&keys).unwrap());
        check_deviation_between("slerp", &slerp, epoch, epoch + 0.49, &mut rng);
        let thrown = random_ballistic(&mut rng).unwrap();
        check_deviation_between("ballistic", &thrown, -1e3, -999.0, &mut rng);
    }
}

#[test]
fn places_may_come_from_afar() {
    let mut rng = Rng::seed_from_u64(6);
    let joint = Joint::prismatic(Pose::IDENTITY, [1.0, 2.0, 3.0]).unwrap();
    let chain = Chain::new(Pose::IDENTITY, vec![joint]);
    let link = chain.link(1, &[1e9], &[0.0], 1.0).unwrap();
    check_deviation_between("link", &link, 0.9, 1.0, &mut rng);
    let stops = vec![
        (0.0, Pose::at([1e9, 0.1, 0.2]).unwrap()),
        (1.0, Pose::IDENTITY),
    ];
    let poses = PosePath::new(stops).unwrap();
    check_deviation_between("poses", &poses, 0.9, 1.0, &mut rng);
}

/// Tests that stretches of no length, and stretches after the end of a trajectory, have a deviation near zero.
#[test]
fn trajectories_rest_after_their_end() {
    let mut rng = Rng::seed_from_u64(7);
    let curve = Curve::bezier(&points(&mut rng, 4), 1.0).unwrap();
    let spline = Spline::new(
        curve,
        OrientationCurve::piecewise_slerp(&keys(&mut rng, 3)).unwrap(),
    );
    let stops = [0.0, 1.0].map(|time| (time, random_motion(&mut rng).unwrap().start()));
    let poses = PosePath::new(stops.to_vec()).unwrap();
    for time in [0.0, 0.5, 1.0, 1.5, 3.0] {
        let strays = [
            spline.stretch_between(time, time),
            poses.stretch_between(time, time),
            spline.stretch_between(2.5, 2.5 + time),
            poses.stretch_between(1.0, 1.0 + time),
        ];
        for stretch in strays {
            let DeviationBound {
                center_deviation: shift,
                max_deviation_angle: turn,
            } = stretch.unwrap().deviation_bound;
            assert!(shift < 1e-10 && turn < 1e-10, "{time}: {shift:e} {turn:e}");
        }
    }
}

#[test]
fn axes_have_any_length_but_0() {
    for length in [1e-300, 1e-161, 1e155, 1e300] {
        let axis = [0.0, 0.0, length];
        let joint = Joint::revolute(Pose::IDENTITY, axis).unwrap();
        assert_eq!(
            joint.motion(0.0, 1.0, 1.0).unwrap().angular_velocity(),
            DVec3::Z
        );
        let screw = screw(Pose::IDENTITY, [0.0; 3], axis, 2.0, 3.0).unwrap();
        assert_eq!(
            (screw.angular_velocity(), screw.velocity()),
            (2.0 * DVec3::Z, 3.0 * DVec3::Z)
        );
        let keys = [(0.0, [0.0, 0.0, 0.0, length])];
        assert_eq!(
            OrientationCurve::piecewise_slerp(&keys).unwrap().at(0.0).0,
            DQuat::IDENTITY
        );
    }
    assert!(Joint::prismatic(Pose::IDENTITY, [0.0; 3]).is_err());
    assert!(screw(Pose::IDENTITY, [0.0; 3], [f64::NAN, 0.0, 0.0], 1.0, 1.0).is_err());
}

/// Tests that a curve whose second differences overflow gives an error, or a deviation bound that is not too small.
#[test]
fn differences_that_overflow_are_unbounded() {
    let points = [[3.0, 0.0, 0.0], [2.0, 1.0, 0.0], [-3.0, 0.0, 0.0]];
    for duration in [1e-155, 1e-160, 1e-300] {
        let keys = [
            (0.0, [0.0, 0.0, 0.0, 1.0]),
            (duration, [0.0, 0.0, 0.6, 0.8]),
        ];
        let curve = Curve::bezier(&points, duration).unwrap();
        let spline = Spline::new(curve, OrientationCurve::piecewise_slerp(&keys).unwrap());
        if let Ok(stretch) = spline.stretch_between(0.0, duration) {
            let deviation = stretch.deviation_bound.center_deviation;
            assert!(deviation >= 0.5, "{duration:e}: {deviation:e}");
        }
    }
}
