//! Tests that poses and frames agree, and refuse invalid input.

use super::{Frame, Pose};
use crate::error::InputError;
use crate::tests::scene::{random_point_in_ball, random_rotation, rng};
use glam::{DQuat, DVec3};
use std::f64::consts::FRAC_1_SQRT_2;

#[test]
fn quaternions_of_any_length_name_the_same_orientation() {
    let mut rng = rng(1);
    for _ in 0..100 {
        let q = random_rotation(&mut rng);
        let (point, at) = (
            random_point_in_ball(&mut rng, 2.0),
            random_point_in_ball(&mut rng, 2.0),
        );
        let unit = Pose::new(at, q).unwrap().transform_point(point);
        for scale in [1e-305, 1e-170, 1e-150, 1e-3, 7.0, 1e150, 1e160, 1e307] {
            let pose = Pose::new(at, q * scale).unwrap();
            assert!((pose.rotation().length() - 1.0).abs() < 1e-15, "{scale:e}");
            assert!(
                pose.transform_point(point).distance(unit) < 1e-14,
                "{scale:e}"
            );
        }
    }
}

#[test]
fn the_extremes_of_length_name_orientations_too() {
    let least = f64::from_bits(1);
    for ([x, w], unit) in [
        ([least; 2], [FRAC_1_SQRT_2; 2]),
        ([f64::MAX; 2], [FRAC_1_SQRT_2; 2]),
        ([least, 0.0], [1.0, 0.0]),
        ([0.0, -f64::MAX], [0.0, -1.0]),
    ] {
        let pose = Pose::new(DVec3::ZERO, [x, 0.0, 0.0, w]).unwrap();
        let expected = DQuat::from_xyzw(unit[0], 0.0, 0.0, unit[1]);
        assert!((pose.rotation() - expected).length() < 1e-15, "{pose:?}");
    }
}

#[test]
fn invalid_poses_are_refused() {
    let zero = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    assert_eq!(
        Pose::new(DVec3::ZERO, zero),
        Err(InputError::ZeroQuaternion)
    );
    let not_finite = |what| Err(InputError::NotFinite { quantity: what });
    for bad in [f64::NAN, f64::INFINITY] {
        let far = DVec3::new(0.0, bad, 0.0);
        assert_eq!(Pose::at(far), not_finite("position"));
        let q = DQuat::from_xyzw(bad, 0.0, 0.0, 1.0);
        assert_eq!(Pose::new(DVec3::ZERO, q), not_finite("quaternion"));
    }
}

#[test]
fn frames_undo_and_combine() {
    let mut rng = rng(2);
    for _ in 0..200 {
        let poses = [(); 2].map(|()| {
            Pose::new(
                random_point_in_ball(&mut rng, 3.0),
                random_rotation(&mut rng),
            )
            .unwrap()
        });
        let [a, b] = poses.map(Frame::from);
        let point = random_point_in_ball(&mut rng, 3.0);
        assert!(
            a.transform_point(point)
                .distance(poses[0].transform_point(point))
                < 1e-14
        );
        assert!(
            a.inverse_transform_point(a.transform_point(point))
                .distance(point)
                < 1e-14
        );
        assert!(
            a.inverse_transform_vector(a.rotation * point)
                .distance(point)
                < 1e-14
        );
        let b_to_a = a.transform_from(&b);
        assert!(
            a.transform_point(b_to_a.transform_point(point))
                .distance(b.transform_point(point))
                < 1e-13
        );
    }
    assert_eq!(Frame::from(Pose::IDENTITY), Frame::IDENTITY);
}
