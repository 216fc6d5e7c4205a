//! An oracle that lies makes the engine slow or unresolved, never late and never wrong.

use ccd_core::glam::DVec3;
use ccd_core::{Config, Limit, Outcome};
use ccd_tests::backends::{Backend, Oracle, Order};
use ccd_tests::checks::{Judge, Law};
use ccd_tests::liars::{Liar, Lie};
use ccd_tests::models::cuboid;
use ccd_tests::query::{Actor, Query};
use ccd_tests::strategies::{cases, check_cases, crowded_cases};

/// Enough for an honest oracle; lies are allowed to spend it.
const BUDGET: u64 = 20_000;

#[test]
fn lies_about_moving_bodies_never_make_an_answer_late() {
    check_cases(250, cases(), every_lie);
}

#[test]
fn lies_about_overlapping_bodies_never_set_them_free() {
    check_cases(250, crowded_cases(), every_lie);
}

fn every_lie(case: &ccd_tests::case::Case) -> Law {
    let query = case.query();
    let config = Config {
        budget: BUDGET,
        ..case.config()
    };
    let judge = Judge::new(&query, &config);
    for bodies in query.all_bodies() {
        let problem = query.problem(&bodies, &config);
        for lie in Lie::ALL {
            let answer = best_first().solve_with(&problem, &mut Liar::new(lie));
            let law = match answer.outcome {
                Outcome::Unresolved { .. } => judge.check_time(&answer, 0.0),
                _ => judge.check(&answer, &bodies),
            };
            law.map_err(|why| format!("{why}\n{lie:?} {:?}\n{answer:?}", bodies.kinds))?;
        }
    }
    Ok(())
}

#[test]
fn nobody_to_ask_is_said_so() {
    let cube = || cuboid(DVec3::splat(0.5));
    let query = Query {
        a: Actor::still(cube(), DVec3::ZERO),
        b: Actor::moving(cube(), 3.0 * DVec3::X, -4.0 * DVec3::X, DVec3::Z),
        duration: 1.0,
    };
    for bodies in query.all_bodies() {
        let problem = query.problem(&bodies, &Config::default());
        let answer = best_first().solve_with(&problem, &mut Liar::new(Lie::GivesUp));
        match answer.outcome {
            Outcome::Unresolved { safe_until, reason } => {
                assert_eq!(reason, Limit::OracleGaveUp, "{answer:?}");
                assert!(safe_until <= 0.5, "{answer:?}");
                assert!(answer.stats.give_ups > 0, "{answer:?}");
            }
            // Boxes around single triangles are proof enough of a contact, if they are.
            other => panic!("{other:?}"),
        }
    }
}

fn best_first() -> Backend {
    Backend {
        order: Order::BestFirst,
        oracle: Oracle::Direct,
    }
}
