use super::*;
use ccd_core::order::greater;

/// Tests, against the support function of the ellipsoid, that the body is nowhere inside it and never exceeds it by more than it
/// says; and that it says no more than a quarter of a percent.
#[test]
fn the_polytope_is_about_the_ellipsoid() {
    for half_axes in [
        [1.0, 2.0, 3.0],
        [1e-3, 1.0, 1.0],
        [0.5, 0.5, 1e-4],
        [3e10, 2e10, 1e10],
        [1e-20, 1e-19, 3e-20],
    ] {
        let body = ellipsoid(half_axes).unwrap();
        let half_axes = DVec3::from_array(half_axes);
        let (longest, excess) = (half_axes.max_element(), body.excess());
        assert!(excess > 0.0 && excess < longest / 400.0, "{excess}");
        let piece = body.pieces().get(0);
        let mut largest = 0.0;
        for k in 0..20_000 {
            let share = (f64::from(k) + 0.5) / 20_000.0;
            let z = 1.0 - 2.0 * share;
            let (sine, cosine) = (2.7 * f64::from(k)).sin_cos();
            let n = DVec3::new(
                (1.0 - z * z).sqrt() * cosine,
                (1.0 - z * z).sqrt() * sine,
                z,
            );
            let exact = (half_axes * n).length();
            let own = piece.points.iter().map(|point| point.dot(n));
            let own = own.fold(f64::NEG_INFINITY, greater);
            assert!(own >= exact * (1.0 - 1e-14), "{own} within {exact}");
            largest = greater(largest, own - exact);
        }
        assert!(largest <= excess, "{largest} of {excess}");
        assert!(largest > 0.3 * excess, "{largest} of {excess}");
    }
}

#[test]
fn equal_half_axes_make_a_ball() {
    let body = ellipsoid([0.3; 3]).unwrap();
    assert_eq!((body.excess(), body.bounding_radius()), (0.0, 0.3));
}

#[test]
fn half_axes_are_checked() {
    for half_axes in [
        [0.0, 1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, f64::NAN],
        [1e12, 1.0, 1.0],
    ] {
        assert!(ellipsoid(half_axes).is_err(), "{half_axes:?}");
    }
}
