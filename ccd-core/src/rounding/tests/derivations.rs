//! Compares the constants that bound errors with the sums of errors in their documentation.

use crate::rounding::*;
use crate::tuning::*;
use glam::DVec3;

/// Checks that the bound `taken` is at least the documented sum `derived`, and at most four times the sum.
fn assert_covers_sum(name: &str, taken: f64, derived: f64) {
    let ratio = taken / derived;
    assert!(
        (1.0..=4.0).contains(&ratio),
        "{name}: {taken} for {derived}"
    );
}

#[test]
fn units_of_rounding_are_half_of_the_last_place() {
    assert!(1.0 + UNIT_ROUNDOFF_F64 == 1.0 && 1.0 + UNIT_ROUNDOFF_F64.next_up() > 1.0);
    assert!(1.0 + UNIT_ROUNDOFF_F32 == 1.0 && 1.0 + UNIT_ROUNDOFF_F32.next_up() > 1.0);
}

#[test]
fn constants_cover_the_operations_that_they_count() {
    let u = f64::from(UNIT_ROUNDOFF_F32);
    for (name, taken, derived) in [
        ("GAP_PER_DISTANCE_F32", GAP_ERROR_PER_DISTANCE_F32, 11.0),
        ("GAP_PER_RADIUS_F32", GAP_ERROR_PER_RADIUS_F32, 28.0),
        ("RATE_F32", RATE_ERROR_F32, 32.0),
        ("FREE_TIME_FACTOR_F32", 1.0 - FREE_TIME_FACTOR_F32, 8.0),
        (
            "SECOND_DERIVATIVE_FACTOR_F32",
            SECOND_DERIVATIVE_FACTOR_F32 - 1.0,
            16.0,
        ),
        ("CROSS_PRODUCT_F32", CROSS_PRODUCT_ERROR_F32, 5.0),
        ("DISC_F32", DISC_HEIGHT_ERROR_F32, 59.0),
        ("DISC_TILT_F32", DISC_TILT_ERROR_F32, 45.0),
        ("BOX_AXES_F32", BOX_EXTENT_ERROR_F32 as f32, 3.5),
        ("FLAT_THICKNESS_F32", MAX_FLAT_NODE_THICKNESS_F32, 4.0),
    ] {
        assert_covers_sum(name, f64::from(taken) / u, derived);
    }
    for (name, taken, derived) in [
        ("RATE_F64", RATE_ERROR_F64, 14.0),
        ("DETERMINANT_F64", DETERMINANT_ERROR_F64, 8.0),
        ("HEIGHT_F64", HEIGHT_ERROR_F64, 3.0),
        ("TURNED_SUPPORT", TURNED_SUPPORT_ERROR, 60.0),
        ("ADVANCE_F64", SCREW_VELOCITY_ERROR_F64, 18.0),
    ] {
        assert_covers_sum(name, taken / UNIT_ROUNDOFF_F64, derived);
    }
}

#[test]
fn functions_cover_the_operations_that_they_count() {
    for (turns, span, way) in [([0.0; 2], 192.0, 56.0), ([0.0, 3.0], 300.0, 96.0)] {
        let derived = span * 7.0 + (span + 5.0 * turns[1]) * 11.0 + way * 13.0;
        let taken = distance_rounding([7.0, 11.0], turns, 13.0);
        assert_covers_sum("distance_rounding", taken / UNIT_ROUNDOFF_F64, derived);
    }
    assert!(distance_rounding([0.0; 2], [0.0; 2], 0.0) > 0.0);
    let [still, turning] = [0.0, 1e-9].map(|turn| distance_rounding([7.0; 2], [turn; 2], 13.0));
    assert!(still < 0.7 * turning);
    assert_covers_sum("least_tolerance", least_tolerance(3.0), 4.0 * 3.0);
    assert_covers_sum(
        "attached_rounding",
        turning_axis_rounding(5.0) / UNIT_ROUNDOFF_F64,
        78.0 + 8.0 * 5.0,
    );
    let sides = [DVec3::new(2.0, -3.0, 0.5), DVec3::new(0.0, 1.0, -5.0)];
    let derived = 108.0 * 3.0 * 5.0 * 7.0;
    assert_covers_sum(
        "height_rounding",
        height_rounding(sides, 7.0) / UNIT_ROUNDOFF_F64,
        derived,
    );
    assert!(height_rounding(sides, 0.0) > 0.0);
    for tilt in [0.0_f64, 11.0, -11.0] {
        let derived = 41.0 * (0.25 + 0.25 + 0.25 * tilt.abs()) * (5.0 + 7.0);
        let taken = profile_rounding([0.25; 2], [5.0, 7.0], tilt);
        assert_covers_sum("profile_rounding", taken / UNIT_ROUNDOFF_F64, derived);
    }
}

#[test]
fn extreme_lengths_scale_to_ordinary_squares() {
    assert_eq!(EXTREME_VECTOR_SCALE, 2f64.powi(700));
    let least = f64::from_bits(1);
    for length in [least, SQUARED_LENGTH_RANGE.start().sqrt()] {
        assert!((length * EXTREME_VECTOR_SCALE).powi(2).is_normal());
    }
    for length in [SQUARED_LENGTH_RANGE.end().sqrt(), f64::MAX] {
        assert!((length * EXTREME_VECTOR_SCALE.recip()).powi(2).is_normal());
    }
}

#[test]
fn shares_are_shares() {
    for share in [
        SKIPPED_PAIR_ALLOWANCE,
        ARM_INCREASE_PER_DISTANCE,
        MIN_ROTATION_GAP_SHARE,
        SUFFICIENT_FIRST_FREE_TIME,
        MIN_NEWTON_GROWTH,
        RESTING_SLACK_PER_ROUNDING,
        NODE_GAP_TOLERANCE_SHARE,
        CLOSED_GAP_TOLERANCE_SHARE,
        MIN_BOX_FILL,
        MAX_SCREW_DRIFT,
        MIN_SCREW_ADVANCE,
        MIN_PROFILE_DISTANCE_SHARE,
        f64::from(MAX_TURNING_PLANE_TIME),
        f64::from(MIN_REVISIT_SWEEP),
        f64::from(ADDED_THICKNESS_PER_RADIUS),
    ] {
        assert!(0.0 < share && share < 1.0, "{share}");
    }
}
