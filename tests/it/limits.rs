//! Every query ends: an exhausted budget leaves it unresolved, up to a certified time.

use ccd_core::{Config, Limit, Outcome};
use ccd_tests::backends::for_each_setup;
use ccd_tests::checks::Judge;
use ccd_tests::strategies::{cases, check_cases};
use std::cell::Cell;

#[test]
fn a_small_budget_ends_in_a_certified_time() {
    let unresolved = Cell::new(0);
    check_cases(250, cases(), |case| {
        let query = case.query();
        let judge = Judge::new(&query, &case.config());
        let mut law = Ok(());
        for budget in [0, 1, 10, 100] {
            let config = Config {
                budget,
                ..case.config()
            };
            for_each_setup(&query, &config, |bodies, setup, answer| {
                let this = match answer.outcome {
                    Outcome::Unresolved {
                        reason: Limit::Budget,
                        ..
                    } => {
                        unresolved.set(unresolved.get() + 1);
                        judge.check_time(&answer, 0.0)
                    }
                    _ => judge.check(&answer, bodies),
                };
                if let Err(why) = this {
                    law = Err(format!("{why}\nbudget {budget} {setup:?}\n{answer:?}"));
                }
            });
        }
        law
    });
    assert!(
        unresolved.get() > 100,
        "only {} runs ran out of budget",
        unresolved.get()
    );
}

#[test]
fn the_certified_time_grows_with_the_budget() {
    let grown = Cell::new(0);
    check_cases(250, cases(), |case| {
        let query = case.query();
        let bodies = query.triangles();
        let mut last = 0.0;
        for budget in [1, 4, 16, 64, 256, 1024] {
            let config = Config {
                budget,
                ..case.config()
            };
            let problem = query.problem(&bodies, &config);
            let answer = ccd_tests::backends::Backend::DEFAULT.solve(&problem);
            let Outcome::Unresolved { safe_until, .. } = answer.outcome else {
                return Ok(());
            };
            if safe_until < last {
                return Err(format!("{safe_until} < {last} with a budget of {budget}"));
            }
            grown.set(grown.get() + u32::from(budget > 1 && safe_until > last));
            last = safe_until;
        }
        Ok(())
    });
    assert!(grown.get() > 100, "grew {} times", grown.get());
}
