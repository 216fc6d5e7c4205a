//! Tests queries that keep more than a million pairs of pieces, or that must visit few of tens of millions of pairs.

use ccd_core::glam::DVec3;
use ccd_core::{Answer, Outcome, Settings};
use ccd_tests::analytic::{ExpectedOutcome, combs_closing, screw_in_nut};
use ccd_tests::backends::{Backend, OracleKind, ScheduleKind};
use ccd_tests::models::{PITCH, square_plate};
use ccd_tests::query::{MovingShape, Query};

/// Returns the answer for a plate of `2·cells²` triangles that falls flat onto another plate. They touch at half of
/// the duration.
fn falling_plate_answer(cells: usize, backend: Backend, tolerance: f64) -> Answer {
    let high = DVec3::new(0.3, 0.2, 0.5);
    let query = Query::new(
        MovingShape::translating_shape(square_plate(cells), high, -DVec3::Z),
        MovingShape::still(square_plate(cells), DVec3::ZERO),
    );
    let config = Settings {
        tolerance,
        budget: u64::MAX,
        ..Settings::DEFAULT
    };
    let bodies = query.bodies_of_triangles();
    backend.solve(&query.problem(&bodies, &config))
}

fn check(answer: &Answer) {
    let Outcome::Contact { time, .. } = answer.outcome else {
        panic!("{answer:?}");
    };
    let earliest = 0.5 - answer.tolerance - 1e-12;
    assert!((earliest..=0.5).contains(&time), "{answer:?}");
}

#[test]
fn a_million_pairs_kept_at_once() {
    let naive = Backend {
        schedule: ScheduleKind::Naive,
        oracle: OracleKind::ClosedForm,
    };
    let answer = falling_plate_answer(23, naive, 1e-3);
    assert!(answer.stats.peak_front > 1_000_000, "{answer:?}");
    check(&answer);
}

#[test]
fn sixty_million_pairs_touching_at_once() {
    for tolerance in [1e-3, 1e-6, 1e-9] {
        check(&falling_plate_answer(64, Backend::DEFAULT, tolerance));
    }
}

/// Tests that two combs of many teeth are in contact at the right time, although thousands of pairs of teeth are
/// in the queue.
#[test]
fn combs_of_many_teeth() {
    let teeth = if slow_tests_enabled() { 512 } else { 96 };
    let scene = combs_closing(teeth);
    let ExpectedOutcome::Hit {
        first_time_within_distance: earliest,
        latest_time: latest,
    } = &scene.expected
    else {
        panic!("combs meet");
    };
    let bodies = scene.query.bodies_of_triangles();
    let answer = Backend::DEFAULT.solve(&scene.query.problem(&bodies, &Settings::DEFAULT));
    let Outcome::Contact { time, .. } = answer.outcome else {
        panic!("{answer:?}");
    };
    assert!(
        (earliest(answer.tolerance) - 1e-12..=*latest).contains(&time),
        "{answer:?}"
    );
}

/// Tests that a fine screw in its nut, T18, is free, although it is near the nut everywhere at all times. A million
/// pairs are in the queue at once.
#[test]
fn a_fine_screw() {
    let scene = screw_in_nut(
        "T18 fine screw",
        PITCH,
        if slow_tests_enabled() { 4 } else { 2 },
    );
    let bodies = scene.query.bodies_of_triangles();
    let config = Settings {
        budget: u64::MAX,
        ..Settings::DEFAULT
    };
    let answer = Backend::DEFAULT.solve(&scene.query.problem(&bodies, &config));
    assert!(matches!(answer.outcome, Outcome::Free { .. }), "{answer:?}");
    assert!(
        !slow_tests_enabled() || answer.stats.peak_front > 1_000_000,
        "{answer:?}"
    );
}

fn slow_tests_enabled() -> bool {
    std::env::var_os("CCD_TEST_SLOW").is_some()
}
