use super::*;

#[test]
fn there_and_back() {
    let rotation = DQuat::from_xyzw(0.1, -0.2, 0.3, 0.9);
    let pose = Pose::new(DVec3::new(1.0, 2.0, 3.0), rotation).unwrap();
    let isometry = Isometry3::from(pose);
    let point = isometry * nalgebra::Point3::new(0.5, -1.0, 2.0);
    let expected = pose.transform_point(DVec3::new(0.5, -1.0, 2.0));
    assert!(DVec3::new(point.x, point.y, point.z).distance(expected) < 1e-14);
    let back = Pose::try_from(isometry).unwrap();
    assert!(back.rotation().angle_between(pose.rotation()) < 1e-7);
    assert_eq!(back.translation(), pose.translation());
}
