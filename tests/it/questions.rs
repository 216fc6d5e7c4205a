//! Compares the answers to every question about random cases with the independent referee and with each other.

use ccd_core::Outcome;
use ccd_tests::backends::default_backend_answer;
use ccd_tests::case::Case;
use ccd_tests::checks::{CheckResult, Judge};
use ccd_tests::questions::{for_each_answer_set, for_each_trajectory_answer_set};
use ccd_tests::strategies::{
    cases, check_cases, convex_cases, crowded_cases, scaled_and_remote_cases,
};

#[test]
fn every_question_of_any_shape() {
    check_cases(80, cases(), check_every_question);
}

#[test]
fn every_question_of_convex_shapes() {
    check_cases(80, convex_cases(), check_every_question);
}

#[test]
fn every_question_near_and_overlapping() {
    check_cases(80, crowded_cases(), check_every_question);
}

#[test]
fn every_question_far_away_tiny_and_huge() {
    check_cases(80, scaled_and_remote_cases(), check_every_question);
}

fn check_every_question(case: &Case) -> CheckResult {
    let (query, config) = (case.query(), case.config());
    let judge = Judge::new(&query, &config);
    let first = default_backend_answer(&query, &config);
    let mut law = Ok(());
    for_each_answer_set(&query, &config, |bodies, asked, answers| {
        if law.is_ok() {
            law = (judge.check_any_contact(&answers.any_contact, bodies))
                .and_then(|()| judge.check_closest_approach(&answers.closest_approach, bodies))
                .and_then(|()| judge.check_clearance(&answers.clearance_check, bodies))
                .and_then(|()| {
                    check_first_and_closest_agree(&first.outcome, &answers.closest_approach.outcome)
                })
                .map_err(|why| format!("{why}\n{asked:?}\n{answers:?}\n{first:?}"));
        }
    });
    for_each_trajectory_answer_set(&query, &config, |bodies, asked, answers| {
        if law.is_ok() {
            law = (judge.check(&answers.first_contact, bodies))
                .and_then(|()| judge.check_any_contact(&answers.any_contact, bodies))
                .and_then(|()| judge.check_closest_approach(&answers.closest_approach, bodies))
                .and_then(|()| judge.check_clearance(&answers.clearance_check, bodies))
                .and_then(|()| judge.check_contact_interval(&answers.contact_interval, bodies))
                .map_err(|why| format!("along: {why}\n{asked:?}\n{answers:?}\n{first:?}"));
        }
    });
    law
}

/// Checks that the bounds of the least distance do not contradict the answer about the first contact.
fn check_first_and_closest_agree(first: &Outcome, closest: &Outcome) -> CheckResult {
    let upper = closest.upper();
    match first {
        Outcome::Free { proven_gap } if upper < *proven_gap => {
            Err(format!("{upper} is below the proven gap {proven_gap}"))
        }
        Outcome::Contact { contact, .. } | Outcome::Touching { contact }
            if closest.lower() > contact.separation.upper =>
        {
            Err("the bounds are above the distance of the contact".into())
        }
        _ => Ok(()),
    }
}
