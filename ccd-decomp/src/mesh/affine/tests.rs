use super::AffineMap;
use ccd_core::Pose;
use ccd_core::glam::{DAffine3, DMat3, DVec3, dvec3};
use dashu_ratio::RBig;
use proptest::prelude::*;

#[test]
fn the_identity_keeps_all_bits() {
    let point = dvec3(-0.0, 1e-300, 1e12);
    let bits = |p: DVec3| p.to_array().map(f64::to_bits);
    assert_eq!(bits(AffineMap::IDENTITY.apply(point)), bits(point));
    let pose = AffineMap::from(Pose::IDENTITY);
    assert_eq!(bits(pose.apply(point)), bits(point));
}

#[cfg(feature = "gltf")]
#[test]
fn maps_follow_each_other() {
    let rotation = ccd_core::glam::DQuat::from_rotation_z(1.0);
    let turned = AffineMap::from(Pose::new([1.0, 0.0, 0.0], rotation).unwrap());
    let stretched = AffineMap::from(DAffine3::from_scale(dvec3(2.0, 3.0, -1.0)));
    let both = turned.compose_after(&stretched);
    let point = dvec3(0.3, -0.7, 2.0);
    let expected = turned.apply(stretched.apply(point));
    assert!(both.apply(point).distance(expected) < 1e-15);
    assert_eq!(turned.compose_after(&AffineMap::IDENTITY), turned);
    assert_eq!(AffineMap::IDENTITY.compose_after(&turned), turned);
    assert!(both.reverses_orientation() && !turned.reverses_orientation());
}

/// Tests that the orientation of a map is exact, even if the products of its determinant cancel, underflow or overflow.
#[test]
fn the_sign_of_a_mirror_is_exact() {
    let mirrors = |columns: [DVec3; 3]| {
        let [x, y, z] = columns;
        AffineMap::from(DAffine3::from_mat3(DMat3::from_cols(x, y, z))).reverses_orientation()
    };
    for scale in [1.0, 1e-160, 1e160, f64::MIN_POSITIVE] {
        let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| scale * axis);
        assert!(!mirrors(columns), "{scale:e}");
        let [x, y, z] = columns;
        assert!(mirrors([x, z, y]), "{scale:e}");
        assert!(
            !mirrors([x, y, x + y]) && !mirrors([x, x + y, y]),
            "{scale:e}"
        );
    }
    // The last column is off the plane of the others by one unit in the last place.
    let (x, y) = (dvec3(0.1, 0.2, 0.3), dvec3(0.7, -0.4, 0.9));
    let near = dvec3(0.8, -0.2, (0.3_f64 + 0.9).next_up());
    assert_ne!(mirrors([x, y, near]), mirrors([y, x, near]));
    assert!(!mirrors([DVec3::NAN, y, x]) && !mirrors([DVec3::INFINITY, y, x]));
}

fn exact_fraction(x: f64) -> RBig {
    RBig::try_from(x).unwrap()
}

proptest! {
    /// Tests that the image of a point is off by at most the documented bound, against exact arithmetic.
    #[test]
    fn images_are_off_by_the_documented_rounding(
        rows in prop::array::uniform3(prop::array::uniform3(-1e3..1e3_f64)),
        translation in prop::array::uniform3(-1e6..1e6_f64),
        point in prop::array::uniform3(-1e6..1e6_f64),
    ) {
        let columns = DMat3::from_cols_array_2d(&rows).transpose();
        let map = AffineMap::from(DAffine3::from_mat3_translation(columns, translation.into()));
        let image = map.apply(point.into());
        for axis in 0..3 {
            let (row, shift) = (rows[axis], translation[axis]);
            let terms = row.iter().zip(point).map(|(&m, x)| exact_fraction(m) * exact_fraction(x));
            let exact = terms.fold(exact_fraction(shift), |sum, term| sum + term);
            let size: f64 = row.iter().zip(point).map(|(m, x)| (m * x).abs()).sum::<f64>() + shift.abs();
            let off = exact_fraction(image[axis]) - exact;
            let allowed = exact_fraction(4.0 * (f64::EPSILON / 2.0) * size * (1.0 + 1e-12));
            prop_assert!(off <= allowed && -off <= allowed);
        }
    }
}
