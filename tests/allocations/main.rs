//! Tests that a warmed-up solver answers the same queries again without allocations.
//!
//! This is a program of its own: the allocator that counts is that of the whole program.

use ccd_distance_gjk::{Direct, Gjk};
use ccd_tests::mixed::MixedBodies;
use rigid_ccd::oracle::DistanceOracle;
use rigid_ccd::{Outcome, Solver};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static COUNTING_ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const QUERY_COUNT: u64 = 3_000;

/// Answers all queries, and returns the number of queries whose bodies are in contact at the start.
fn count_start_contacts<O: DistanceOracle>(mixed: &MixedBodies, solver: &mut Solver<O>) -> u64 {
    let mut at_start = 0;
    for number in 0..QUERY_COUNT {
        let query = mixed.query(number);
        let [a, b] = [0, 1].map(|k| mixed.moving_body(&query, k));
        solver.set_settings(query.config);
        let answer = solver.first_contact(a, b, 1.0).expect("a well-posed query");
        if let Outcome::Touching { .. } | Outcome::Overlapping { .. } = answer.outcome {
            at_start += 1;
        }
    }
    at_start
}

// There is a single test, because the count covers all threads.
#[test]
fn queries_do_not_allocate_once_the_solver_is_warm() {
    let mixed = MixedBodies::new();
    assert_no_allocations_when_warm(&mixed, Direct::default());
    assert_no_allocations_when_warm(&mixed, Gjk);
}

fn assert_no_allocations_when_warm<O: DistanceOracle>(mixed: &MixedBodies, oracle: O) {
    let mut solver = Solver::with_oracle(oracle);
    let cold = Region::new(COUNTING_ALLOCATOR);
    let at_start = count_start_contacts(mixed, &mut solver);
    // The check can fail: the first round allocates.
    assert!(cold.change().allocations > 0);
    assert!(at_start > QUERY_COUNT / 100, "{at_start}");
    let warm = Region::new(COUNTING_ALLOCATOR);
    count_start_contacts(mixed, &mut solver);
    let change = warm.change();
    assert_eq!(
        (change.allocations, change.reallocations),
        (0, 0),
        "{change:?}"
    );
}
