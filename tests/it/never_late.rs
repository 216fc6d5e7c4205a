//! Tests that answers to random cases are never late, never false, and tight, compared with the independent referee.

use ccd_tests::backends::{Backend, for_each_setup};
use ccd_tests::case::Case;
use ccd_tests::checks::{CheckResult, Judge};
use ccd_tests::strategies::{
    cases, check_cases, convex_cases, crowded_cases, scaled_and_remote_cases,
};

#[test]
fn triangles_of_any_shape() {
    check_cases(800, cases(), |case| {
        let query = case.query();
        let judge = Judge::new(&query, &case.config());
        let bodies = query.bodies_of_triangles();
        let answer = Backend::DEFAULT.solve(&query.problem(&bodies, &case.config()));
        judge.check(&answer, &bodies)
    });
}

#[test]
fn every_setup_of_any_shape() {
    check_cases(200, cases(), check_every_setup);
}

#[test]
fn every_setup_of_convex_shapes() {
    check_cases(150, convex_cases(), check_every_setup);
}

#[test]
fn every_setup_near_and_overlapping() {
    check_cases(150, crowded_cases(), check_every_setup);
}

#[test]
fn every_setup_far_away_tiny_and_huge() {
    check_cases(150, scaled_and_remote_cases(), check_every_setup);
}

fn check_every_setup(case: &Case) -> CheckResult {
    let query = case.query();
    let judge = Judge::new(&query, &case.config());
    let mut law = Ok(());
    for_each_setup(&query, &case.config(), |bodies, setup, answer| {
        if law.is_ok() {
            law = judge
                .check(&answer, bodies)
                .map_err(|why| format!("{why}\n{setup:?}\n{answer:?}"));
        }
    });
    law
}
