use super::*;

#[test]
fn times_are_never_rounded_up() {
    let mut exact = 0;
    for k in 0..2000 {
        let given = (f64::from(k) * 0.37).exp2() * 1e-30 * 1.000_000_01;
        for given in [given, -given, 1.0 / f64::from(k + 1), f64::from(k)] {
            let near = f64::from(time(given));
            assert!(near <= given, "{given:e} became {near:e}");
            // The next float is later.
            assert!(f64::from(time(given).next_up()) > given, "{given:e}");
            exact += u32::from(near == given);
        }
    }
    assert!(exact >= 2000);
}

#[test]
fn times_beyond_all_numbers_are_the_largest() {
    assert!(f64::from(time(f64::MAX)) <= f64::MAX && time(f64::MAX).is_finite());
    assert_eq!(time(0.0), 0.0);
    assert!(f64::from(time(5e-324)) <= 5e-324);
}

#[test]
fn orientations_are_made_units() {
    let rotation = super::super::library::math::Rotation::from_xyzw(0.0, 0.0, 2.0, 2.0);
    let turned = pose_from_parry(&ParryPose::from_parts(Vector::X, rotation)).expect("a pose");
    let point = turned.transform_point(DVec3::X);
    assert!(point.distance(DVec3::new(1.0, 1.0, 0.0)) < 1e-15, "{point}");
}
