//! Tests that every query ends: an exhausted budget or a stop leaves it unresolved, with a certified time.

use ccd_core::Unresolved;
use ccd_core::schedule::BestFirst;
use ccd_core::{
    Claim, DistanceOracle, GiveUpReason, Limit, Outcome, PiecePair, Schedule, Settings,
};
use ccd_distance_gjk::Gjk;
use ccd_tests::backends::for_each_setup;
use ccd_tests::checks::Judge;
use ccd_tests::strategies::{cases, check_cases};
use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

#[test]
fn a_small_budget_ends_in_a_certified_time() {
    let unresolved = Cell::new(0);
    check_cases(100, cases(), |case| {
        let query = case.query();
        let judge = Judge::new(&query, &case.config());
        let mut law = Ok(());
        for budget in [0, 1, 10, 100] {
            let config = Settings {
                budget,
                ..case.config()
            };
            for_each_setup(&query, &config, |bodies, setup, answer| {
                let this = match answer.outcome {
                    Outcome::Unresolved(Unresolved {
                        limit: Limit::Budget,
                        ..
                    }) => {
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
        unresolved.get() > 40,
        "only {} runs ran out of budget",
        unresolved.get()
    );
}

#[test]
fn the_certified_time_grows_with_the_budget() {
    let grown = Cell::new(0);
    check_cases(100, cases(), |case| {
        let query = case.query();
        let bodies = query.bodies_of_triangles();
        let mut last = 0.0;
        for budget in [1, 4, 16, 64, 256, 1024] {
            let config = Settings {
                budget,
                ..case.config()
            };
            let problem = query.problem(&bodies, &config);
            let answer = ccd_tests::backends::Backend::DEFAULT.solve(&problem);
            let Outcome::Unresolved(Unresolved { safe_until, .. }) = answer.outcome else {
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
    assert!(grown.get() > 40, "grew {} times", grown.get());
}

/// An oracle that requests a stop of the query after `calls` calls, and goes on answering.
struct StoppingOracle {
    calls: u32,
    stop: Arc<AtomicBool>,
}

impl DistanceOracle for StoppingOracle {
    type Cache = <Gjk as DistanceOracle>::Cache;

    fn separation(
        &mut self,
        pair: &PiecePair<'_>,
        cache: &mut Self::Cache,
    ) -> Result<Claim, GiveUpReason> {
        if self.calls == 0 {
            self.stop.store(true, Ordering::Relaxed);
        }
        self.calls = self.calls.saturating_sub(1);
        Gjk.separation(pair, cache)
    }
}

#[test]
fn a_stopped_query_keeps_what_it_has_proven() {
    let (stopped, advanced) = (Cell::new(0), Cell::new(0));
    check_cases(100, cases(), |case| {
        let query = case.query();
        let bodies = query.bodies_of_triangles();
        let judge = Judge::new(&query, &case.config());
        for calls in [0, 3, 30] {
            let stop = Arc::new(AtomicBool::new(false));
            let mut oracle = StoppingOracle {
                calls,
                stop: Arc::clone(&stop),
            };
            let settings = Settings {
                stop: Some(Arc::clone(&stop)),
                ..case.config()
            };
            let problem = query.problem(&bodies, &settings);
            let answer = BestFirst::default()
                .first_contact(&problem, &mut oracle)
                .unwrap();
            if let Outcome::Unresolved(Unresolved {
                safe_until,
                limit: reason,
                ..
            }) = answer.outcome
            {
                stopped.set(stopped.get() + u32::from(reason == Limit::Stopped));
                advanced.set(advanced.get() + u32::from(safe_until > 0.0));
            }
            judge.check_time(&answer, 0.0)?;
        }
        Ok(())
    });
    let (stopped, advanced) = (stopped.get(), advanced.get());
    assert!(stopped >= 8 && advanced >= 2, "{stopped} {advanced}");
}
