//! Tests that an oracle that breaks its contract makes the engine slow or unresolved, but never late or wrong.

use ccd_core::Unresolved;
use ccd_core::glam::DVec3;
use ccd_core::{Answer, Limit, Outcome, Settings};
use ccd_tests::backends::{Backend, OracleKind, ScheduleKind};
use ccd_tests::case::Case;
use ccd_tests::checks::{CheckResult, Judge};
use ccd_tests::liars::{ContractBreach, FaultyOracle};
use ccd_tests::models::cuboid;
use ccd_tests::query::{MovingShape, Query};
use ccd_tests::strategies::{cases, check_cases, crowded_cases};
use proptest::strategy::Strategy;
use std::cell::Cell;

/// A work budget that is enough for an honest oracle. An oracle that lies may exhaust it.
const BUDGET: u64 = 20_000;

#[test]
fn lies_about_moving_bodies_never_make_an_answer_late() {
    check_cases_with_every_breach(cases());
}

#[test]
fn lies_about_overlapping_bodies_never_set_them_free() {
    check_cases_with_every_breach(crowded_cases());
}

/// Checks the answers of an oracle that breaks its contract in every way: some queries are answered correctly, the
/// others stay unresolved.
fn check_cases_with_every_breach(cases: impl Strategy<Value = Case>) {
    let (answered, unresolved) = (Cell::new(0), Cell::new(0));
    check_cases(100, cases, |case| {
        check_every_breach(case, |answer| {
            let count = match answer.outcome {
                Outcome::Unresolved(_) => &unresolved,
                _ => &answered,
            };
            count.set(count.get() + 1);
        })
    });
    assert!(
        answered.get() > 120 && unresolved.get() > 400,
        "{answered:?} {unresolved:?}"
    );
}

fn check_every_breach(case: &Case, count: impl Fn(&Answer)) -> CheckResult {
    let query = case.query();
    let config = Settings {
        budget: BUDGET,
        ..case.config()
    };
    let judge = Judge::new(&query, &config);
    for bodies in query.bodies_of_kind_pairs() {
        let problem = query.problem(&bodies, &config);
        for lie in ContractBreach::ALL {
            let answer = best_first().solve_with(&problem, &mut FaultyOracle::new(lie));
            count(&answer);
            let law = match answer.outcome {
                Outcome::Unresolved(_) => judge.check_time(&answer, 0.0),
                _ => judge.check(&answer, &bodies),
            };
            law.map_err(|why| format!("{why}\n{lie:?} {:?}\n{answer:?}", bodies.piece_kinds))?;
        }
    }
    Ok(())
}

#[test]
fn a_missing_oracle_is_reported() {
    let cube = || cuboid(DVec3::splat(0.5));
    let query = Query::new(
        MovingShape::still(cube(), DVec3::ZERO),
        MovingShape::moving(cube(), 3.0 * DVec3::X, -4.0 * DVec3::X, DVec3::Z),
    );
    for bodies in query.bodies_of_kind_pairs() {
        let problem = query.problem(&bodies, &Settings::DEFAULT);
        let answer =
            best_first().solve_with(&problem, &mut FaultyOracle::new(ContractBreach::GivesUp));
        match answer.outcome {
            Outcome::Unresolved(Unresolved {
                safe_until,
                limit: reason,
                ..
            }) => {
                assert_eq!(reason, Limit::OracleGaveUp, "{answer:?}");
                assert!(safe_until <= 0.5, "{answer:?}");
                assert!(answer.stats.give_ups > 0, "{answer:?}");
            }
            // The boxes around single triangles are enough to prove a contact.
            other => panic!("{other:?}"),
        }
    }
}

fn best_first() -> Backend {
    Backend {
        schedule: ScheduleKind::BestFirst,
        oracle: OracleKind::Direct,
    }
}
