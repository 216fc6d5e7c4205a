//! Tests that normals and volumes keep the digits that f64 alone would lose.

use super::*;

#[test]
fn slivers_have_normals() {
    // The difference of both products is 2⁻¹⁰⁴.
    let tiny = 1.0 + f64::EPSILON;
    let (a, b) = (DVec3::new(tiny, 1.0, 0.0), DVec3::new(1.0, 1.0 / 1.0, 0.0));
    let zero = DVec3::ZERO;
    let cross =
        DoubleDoubleVector::difference(a, zero).cross(DoubleDoubleVector::difference(b, zero));
    assert_eq!(cross.value(), DVec3::new(0.0, 0.0, f64::EPSILON));
    let square = DVec3::new(tiny, 1.0, 0.0);
    let other = DVec3::new(1.0, 2.0 - tiny, 0.0);
    let cross = DoubleDoubleVector::difference(square, zero)
        .cross(DoubleDoubleVector::difference(other, zero));
    assert_eq!(cross.value().z, -f64::EPSILON * f64::EPSILON);
}

#[test]
fn volumes_have_signs() {
    let base = [DVec3::ZERO, DVec3::X, DVec3::Y];
    assert_eq!(six_times_signed_volume(base, 2.0 * DVec3::Z), 2.0);
    assert_eq!(
        six_times_signed_volume(base, -DVec3::Z + 9.0 * DVec3::X),
        -1.0
    );
}
