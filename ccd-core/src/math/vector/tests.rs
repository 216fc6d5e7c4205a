//! Compares lengths and unit vectors with double-double arithmetic, for all magnitudes.

use super::{distance, length, normal, unit, vector_perpendicular_to_both};
use crate::rounding::UNIT_ROUNDOFF_F64;
use crate::tests::double::DoubleDouble3;
use crate::tests::scene::{Pcg64, RngExt, random_direction, rng};
use glam::DVec3;

/// Draws a number of either sign and of any magnitude below 2¹⁰⁰⁰, denormal numbers and zero included.
fn random_number_of_any_magnitude(rng: &mut Pcg64) -> f64 {
    let exponent = rng.random_range(-1074..1000);
    let sign = if rng.random_range(0..2) == 0 {
        1.0
    } else {
        -1.0
    };
    match rng.random_range(0..8) {
        0 => 0.0,
        _ => {
            sign * rng.random_range(1.0..2.0)
                * 2f64.powi(exponent / 2)
                * 2f64.powi(exponent - exponent / 2)
        }
    }
}

/// Draws a vector of any magnitude, with components of similar or different magnitudes.
fn random_vector(rng: &mut Pcg64) -> DVec3 {
    match rng.random_range(0..2) {
        0 => DVec3::new(
            random_number_of_any_magnitude(rng),
            random_number_of_any_magnitude(rng),
            random_number_of_any_magnitude(rng),
        ),
        _ => random_direction(rng) * random_number_of_any_magnitude(rng),
    }
}

/// Scales a vector so that its largest component is near 1.
fn scaled_near_one(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    let half = 2f64.powf((-0.5 * largest.log2()).round());
    v * half * half
}

#[test]
fn units_are_units_of_the_same_direction() {
    let mut rng = rng(31);
    let mut denormal = 0;
    for _ in 0..200_000 {
        let v = random_vector(&mut rng);
        let Some(n) = unit(v) else {
            assert_eq!(v, DVec3::ZERO);
            continue;
        };
        denormal += usize::from(v.abs().max_element() < f64::MIN_POSITIVE);
        let n = DoubleDouble3::from(n);
        assert!(
            (n.length().get() - 1.0).abs() <= 4.0 * UNIT_ROUNDOFF_F64,
            "{v:?}"
        );
        let off = (n - DoubleDouble3::from(scaled_near_one(v)).unit())
            .length()
            .get();
        assert!(off <= 4.0 * UNIT_ROUNDOFF_F64, "{v:?}: {off:e}");
    }
    assert!(denormal > 1_000, "{denormal}");
    for none in [DVec3::ZERO, -DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
        assert_eq!(unit(none), None);
    }
    assert_eq!(unit(DVec3::new(f64::NAN, 1.0, 0.0)), None);
    assert_eq!(unit(DVec3::splat(f64::from_bits(1))), unit(DVec3::ONE));
    let huge = unit(DVec3::X * f64::MAX).unwrap();
    assert!((huge.x - 1.0).abs() <= UNIT_ROUNDOFF_F64);
}

#[test]
fn lengths_are_right() {
    assert_eq!(length(DVec3::ZERO), 0.0);
    assert!(length(DVec3::NAN).is_nan());
    assert_eq!(length(DVec3::new(3e-320, 4e-320, 0.0)), 5e-320);
    assert_eq!(length(DVec3::X * f64::MAX), f64::MAX);
    assert_eq!(distance(DVec3::X * 1e-200, DVec3::X * -1e-200), 2e-200);
    let mut rng = rng(32);
    for _ in 0..100_000 {
        let v = random_vector(&mut rng);
        let largest = v.abs().max_element();
        if largest == 0.0 {
            continue;
        }
        // The vector is scaled twice by half the exponent: a single power of two may be out of range.
        let half = 2f64.powf((-0.5 * largest.log2()).round());
        let exact = DoubleDouble3::from(v * half * half).length().get() / half / half;
        let least = f64::from_bits(1);
        assert!(
            (length(v) - exact).abs() <= 4.0 * UNIT_ROUNDOFF_F64 * exact + least,
            "{v:?}"
        );
    }
}

#[test]
fn normals_are_those_of_triangles_of_any_size() {
    let mut rng = rng(33);
    for _ in 0..100_000 {
        let (u, v) = (random_direction(&mut rng), random_direction(&mut rng));
        if u.cross(v).length() < 0.1 {
            continue;
        }
        let exponent = || [-1000, -540, -520, -300, 0, 300];
        let [p, q] = [(); 2].map(|()| 2f64.powi(exponent()[rng.random_range(0..6)]));
        let found = normal([DVec3::ZERO, u * p, v * q]).unwrap();
        let exact = DoubleDouble3::from(u).cross(DoubleDouble3::from(v)).unit();
        let off = (DoubleDouble3::from(found) - exact).length().get();
        assert!(off < 100.0 * UNIT_ROUNDOFF_F64, "{p:e} {q:e}: {off:e}");
    }
    // The corners are on one line, or at one point.
    assert_eq!(normal([DVec3::ZERO, DVec3::X, 3.0 * DVec3::X]), None);
    assert_eq!(normal([DVec3::X; 3]), None);
    assert_eq!(
        vector_perpendicular_to_both(DVec3::X * 1e-300, DVec3::X),
        DVec3::ZERO
    );
}
