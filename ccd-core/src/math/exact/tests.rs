use super::*;
use glam::dvec3;

#[test]
fn the_last_bit_decides() {
    let triangle = [
        dvec3(0.1, 0.1, 0.1),
        dvec3(0.3, 0.1, 0.1),
        dvec3(0.1, 0.7, 0.1),
    ];
    let above = f64::from_bits(0.1f64.to_bits() + 1);
    assert_eq!(
        side_of_plane(triangle, dvec3(1e5, 1e5, 0.1)),
        Ordering::Equal
    );
    assert_eq!(
        side_of_plane(triangle, dvec3(1e5, 1e5, above)),
        Ordering::Greater
    );
    assert_eq!(
        side_of_plane(triangle, dvec3(0.2, 0.2, 0.0)),
        Ordering::Less
    );
}

#[test]
fn coordinates_near_zero_are_reported() {
    let points = [DVec3::ZERO, DVec3::X, dvec3(0.0, 1e-91, 0.0)];
    assert_eq!(first_underflow_prone_point_index(&points), Some(2));
    assert_eq!(first_underflow_prone_point_index(&points[..2]), None);
}
