//! The sign is that of the side on which a point lies.

use super::orientation;
use ccd_core::glam::DVec3;

#[test]
fn signs_are_those_of_the_sides_of_a_triangle() {
    let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
    assert!(orientation(triangle, DVec3::Z) > 0.0);
    assert!(orientation(triangle, DVec3::new(0.3, 0.3, -1e-80)) < 0.0);
    assert_eq!(orientation(triangle, DVec3::new(7.0, -3.0, 0.0)), 0.0);
}
