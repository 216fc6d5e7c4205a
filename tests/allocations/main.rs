//! A solver that has answered queries before answers them again without any allocation.
//!
//! This is a program of its own: the allocator that counts is that of the whole program.

use ccd_distance_gjk::{Direct, Gjk};
use ccd_tests::mixed::Mixed;
use rigid_ccd::{DistanceOracle, Outcome, Solver};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const QUERIES: u64 = 3_000;

/// Answers all queries, and returns how many are contacts.
fn answer_all<O: DistanceOracle>(mixed: &Mixed, solver: &mut Solver<O>) -> usize {
    let mut contacts = 0;
    for number in 0..QUERIES {
        let posed = mixed.posed(number);
        let [a, b] = [0, 1].map(|k| mixed.moving(&posed, k));
        solver.set_config(posed.config);
        let answer = solver.answer(a, b, 1.0).expect("a well-posed query");
        contacts += usize::from(matches!(answer.outcome, Outcome::Contact { .. }));
    }
    contacts
}

// One test: the count is that of all threads.
#[test]
fn queries_do_not_allocate_once_the_solver_is_warm() {
    let mixed = Mixed::new();
    assert_warm(&mixed, Direct::default());
    assert_warm(&mixed, Gjk);
}

fn assert_warm<O: DistanceOracle>(mixed: &Mixed, oracle: O) {
    let cold = Region::new(HEAP);
    let mut solver = Solver::with_oracle(oracle);
    let contacts = answer_all(mixed, &mut solver);
    // The check can fail: the first round does allocate.
    assert!(cold.change().allocations > 0);
    assert!((500..2_500).contains(&contacts), "{contacts}");
    let warm = Region::new(HEAP);
    let again = answer_all(mixed, &mut solver);
    let change = warm.change();
    assert_eq!(
        (change.allocations, change.reallocations),
        (0, 0),
        "{change:?}"
    );
    assert_eq!(again, contacts);
}
