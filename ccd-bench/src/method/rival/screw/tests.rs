use super::*;
use crate::method::rival::tests::samples::{RandomSource, query, resting_motion};
use ccd_core::Pose;
use ccd_core::order::lesser;

fn position_difference(a: Pose, b: Pose, point: DVec3) -> f64 {
    a.transform_point(point).distance(b.transform_point(point))
}

#[test]
fn screws_start_and_end_where_the_motion_does() {
    let mut samples = RandomSource::new(1);
    let mut between = 0;
    for _ in 0..2000 {
        // The turn is at most 2.7 circles.
        let query = samples.query(3.0, 10.0);
        let screw = to_screw_motions(&query).unwrap();
        assert_eq!((screw.duration, &screw.id), (query.duration, &query.id));
        for (screw, motion) in [(screw.a, query.a), (screw.b, query.b)] {
            let point = samples.vector(1.0);
            let sine = (0.5 * motion.angular_velocity().length()).sin().abs();
            let slack = 1e-12 / lesser(1.0, 10.0 * sine);
            assert!(position_difference(screw.pose(0.0), motion.pose(0.0), point) <= slack);
            assert!(position_difference(screw.pose(1.0), motion.pose(1.0), point) <= slack);
            assert!(
                screw.velocity().cross(screw.angular_velocity()).length()
                    <= 1e-12 * screw.angular_velocity().length()
            );
            between +=
                usize::from(position_difference(screw.pose(0.5), motion.pose(0.5), point) > 0.1);
        }
    }
    assert!(between > 2000, "in between they differ: {between}");
}

#[test]
fn points_of_the_axis_slide_along_it() {
    let mut samples = RandomSource::new(2);
    for _ in 0..200 {
        let screw = to_screw_motions(&samples.query(3.0, 3.0)).unwrap().a;
        let center = |t: f64| screw.pose(t).transform_point(screw.center());
        let path = center(1.0) - center(0.0);
        assert!((path - screw.velocity()).length() < 1e-11);
    }
}

#[test]
fn translations_and_turns_about_the_center_stay_as_they_are() {
    let mut samples = RandomSource::new(3);
    for _ in 0..100 {
        let translation = samples.motion(3.0, 1e-300);
        let translation = Motion::about(
            translation.start(),
            translation.velocity(),
            DVec3::ZERO,
            DVec3::X,
        )
        .unwrap();
        let start = translation.start();
        let turn = Motion::new(start, DVec3::ZERO, samples.vector(8.0)).unwrap();
        let given = query(translation, turn);
        assert_eq!(to_screw_motions(&given).unwrap(), given);
    }
}

#[test]
fn whole_turns_have_no_axis_and_are_unchanged() {
    let whole = std::f64::consts::TAU * DVec3::Z;
    for spin in [whole, 2.0 * whole, 1e-16 * DVec3::Z, whole * (1.0 + 1e-5)] {
        let motion = Motion::new(Pose::IDENTITY, DVec3::X, spin).unwrap();
        let given = query(motion, resting_motion(DVec3::ZERO));
        assert_eq!(to_screw_motions(&given).unwrap(), given);
    }
    // With a slightly larger rotation there is an axis, far away.
    let motion = Motion::new(Pose::IDENTITY, DVec3::X, 1e-3 * DVec3::Z).unwrap();
    let screw = to_screw_motions(&query(motion, resting_motion(DVec3::ZERO))).unwrap();
    assert!((screw.a.center().length() - 1e3).abs() < 1.0);
    assert!(position_difference(screw.a.pose(1.0), motion.pose(1.0), DVec3::Y) < 1e-12);
}

#[test]
fn overflow_is_an_error() {
    let motion = Motion::new(Pose::IDENTITY, 1e308 * DVec3::X, 1e-3 * DVec3::Z).unwrap();
    let result = to_screw_motions(&query(motion, resting_motion(DVec3::ZERO)));
    assert!(matches!(result, Err(InputError::NotFinite { .. })));
}

#[test]
fn screws_are_distinguished_from_other_motions() {
    let mut samples = RandomSource::new(4);
    for _ in 0..200 {
        let given = samples.query(3.0, 3.0);
        assert!(!are_screw_motions(&given));
        assert!(are_screw_motions(&to_screw_motions(&given).unwrap()));
    }
    assert!(are_screw_motions(&query(
        resting_motion(DVec3::X),
        resting_motion(DVec3::ZERO)
    )));
}
