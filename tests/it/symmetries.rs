//! Tests that the order of the bodies, the frame of reference and the direction of time do not affect the answer.

use ccd_core::glam::DVec3;
use ccd_core::{Outcome, Pose};
use ccd_tests::backends::default_backend_answer;
use ccd_tests::checks::Judge;
use ccd_tests::strategies::runner;
use ccd_tests::strategies::{cases, check_cases, direction, rotation};
use proptest::prelude::*;
use std::cell::Cell;

#[test]
fn bodies_may_be_swapped() {
    check_cases(400, cases(), |case| {
        let query = case.query();
        let judge = Judge::new(&query, &case.config());
        let (here, there) = (
            default_backend_answer(&query, &case.config()),
            default_backend_answer(&query.swapped(), &case.config()),
        );
        judge.check_time(&here, 0.0)?;
        judge
            .check_time(&there, 0.0)
            .map_err(|why| format!("swapped: {why}\n{there:?}"))
    });
}

#[test]
fn both_may_be_seen_from_any_frame() {
    let frames = (cases(), direction(), -1.0..6.0f64, rotation());
    let law = |(case, towards, far, rotation): (ccd_tests::case::Case, DVec3, f64, _)| {
        let query = case.query();
        let frame = Pose::new(10.0f64.powf(far) * towards, rotation).expect("a pose");
        let moved = query.seen_from(&frame);
        let judge = Judge::new(&query, &case.config());
        let answer = default_backend_answer(&moved, &case.config());
        judge
            .check_time(&answer, moved.rounding())
            .map_err(|why| TestCaseError::fail(format!("{why}\n{answer:?}\n{}", case.to_toml())))
    };
    if let Err(error) = runner(1_000).run(&frames, law) {
        panic!("{error}");
    }
}

/// Tests that the reverse of a free motion is free, except for rare contacts of bodies that passed each other within
/// the tolerance.
#[test]
fn a_free_motion_in_reverse_is_free() {
    let (free, grazing) = (Cell::new(0), Cell::new(0));
    check_cases(400, cases(), |case| {
        let query = case.query();
        let forwards = default_backend_answer(&query, &case.config());
        if !matches!(forwards.outcome, Outcome::Free { .. }) {
            return Ok(());
        }
        let reversed = query.reversed();
        let backwards = default_backend_answer(&reversed, &case.config());
        Judge::new(&reversed, &case.config()).check_time(&backwards, query.rounding())?;
        let count = match backwards.outcome {
            Outcome::Free { .. } => &free,
            Outcome::Contact { .. } | Outcome::Touching { .. } => &grazing,
            other => return Err(format!("free forwards, but {other:?} backwards")),
        };
        count.set(count.get() + 1);
        Ok(())
    });
    let (free, grazing) = (free.get(), grazing.get());
    assert!(
        free > 40 && 50 * grazing <= free,
        "{free} free, {grazing} grazing"
    );
}
