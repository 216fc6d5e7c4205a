//! Tests that interval sines and cosines contain known values, and that interval rotations are close to known ones.

use super::super::enclosure::{IntervalMatrix, sin_cos};
use super::super::interval::{Interval, point_interval};
use ccd_core::glam::{DMat3, DQuat, DVec3};

/// An argument in radians, its sine and its cosine, the last two as a float and the remainder. Sine and cosine are
/// unevaluated sums of two floats, from 120 decimals.
#[rustfmt::skip]
#[expect(clippy::approx_constant, reason = "floats, not the constants near them")]
const KNOWN_SINES_AND_COSINES: [(f64, [f64; 2], [f64; 2]); 11] = [
    (1e-08, [1e-08, -1.6666666666666668e-25], [1.0, -5e-17]),
    (0.1, [0.09983341664682815, 3.08001512929492e-18], [0.9950041652780258, -5.50210156918377e-17]),
    (0.7853981633974483, [0.7071067811865475, 4.1036934489363755e-17], [0.7071067811865476, -2.6687565161377232e-17]),
    (1.0, [0.8414709848078965, 1.776845092935536e-18], [0.5403023058681398, -4.760954612604417e-17]),
    (1.5707963267948966, [1.0, -1.874699728327322e-33], [6.123233995736766e-17, -1.4973849048591698e-33]),
    (-2.5, [-0.5984721441039565, 5.521403334082375e-17], [-0.8011436155469337, -1.8674742705085553e-17]),
    (3.141592653589793, [1.2246467991473532e-16, -2.99476980971834e-33], [-1.0, 7.498798913309288e-33]),
    (10.0, [-0.5440211108893698, -3.8949898668223557e-17], [-0.8390715290764524, -1.4147119988953418e-17]),
    (100.0, [-0.5063656411097588, -3.050947053792115e-18], [0.8623188722876839, 4.334809858136501e-17]),
    (-12345.678, [0.7040813137533816, 1.9646969196301474e-17], [0.7101193587160628, -2.4815747415365305e-17]),
    (1e9, [0.5458434494486996, 6.1757333566640775e-18], [0.8378871813639024, -5.4718713289282437e-17]),
];

#[test]
fn sines_and_cosines_hold_the_exact_values() {
    for (x, sine, cosine) in KNOWN_SINES_AND_COSINES {
        let enclosed = sin_cos(point_interval(x));
        for ([high, low], found) in [(sine, enclosed.0), (cosine, enclosed.1)] {
            // Differences of neighbouring floats are exact.
            assert!(
                found.inf() - high <= low && low <= found.sup() - high,
                "{x}: {found:?}"
            );
            assert!(
                width(found) <= 1e-15 + 4e-16 * x.abs(),
                "{x}: {:e}",
                width(found)
            );
        }
    }
}

#[test]
fn wide_arguments_have_all_that_is_in_them() {
    for (low, high) in [
        (0.1, 0.4),
        (-0.5, 0.5),
        (1.2, 2.1),
        (3.0, 4.0),
        (-20.0, 90.0),
    ] {
        let (sine, cosine) = sin_cos(Interval::new(low, high));
        for k in 0..=100 {
            let x: f64 = low + (high - low) * f64::from(k) / 100.0;
            let near =
                |found: Interval, y: f64| found.inf() <= y + 1e-15 && y <= found.sup() + 1e-15;
            assert!(
                near(sine, x.sin()) && near(cosine, x.cos()),
                "{x} in {low}..{high}"
            );
        }
    }
    let (sine, cosine) = sin_cos(Interval::ALL_REALS);
    assert_eq!([width(sine), width(cosine)], [2.0, 2.0]);
}

#[test]
fn rotations_are_those_of_floats_and_narrow() {
    for (spin, time) in [
        (DVec3::new(0.3, -2.0, 0.7), 0.8),
        (DVec3::new(1e-9, 0.0, 2e-9), 1.0),
        (DVec3::new(40.0, 30.0, -20.0), 1.0),
        (DVec3::ZERO, 1.0),
        (DVec3::new(1e-200, 0.0, 0.0), 1.0),
    ] {
        let expected = DMat3::from_quat(DQuat::from_scaled_axis(spin * time));
        let off = 1e-15 * (2.0 + spin.length() * time);
        assert_close(&IntervalMatrix::rotation_after(spin, time), expected, off);
    }
    let quaternion = DQuat::from_xyzw(0.5, -0.1, 0.3, 0.7).normalize();
    let matrix = IntervalMatrix::from_quaternion(quaternion * 3.0);
    assert_close(&matrix, DMat3::from_quat(quaternion), 2e-15);
}

fn assert_close(found: &IntervalMatrix, expected: DMat3, off: f64) {
    let rows = expected.transpose().to_cols_array_2d();
    for (&found, expected) in found.0.iter().flatten().zip(rows.iter().flatten()) {
        assert!(
            (found.midpoint() - expected).abs() <= off,
            "{found:?} {expected}"
        );
        assert!(width(found) <= 4.0 * off, "{:e}", width(found));
    }
}

fn width(x: Interval) -> f64 {
    x.sup() - x.inf()
}
