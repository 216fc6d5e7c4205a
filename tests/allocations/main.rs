//! A solver that has answered queries about meshes before answers them again without any allocation.
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

/// Answers queries, and adds those of them whose bodies are of triangles, and apart at the start.
fn answer_all<O: DistanceOracle>(
    mixed: &Mixed,
    solver: &mut Solver<O>,
    queries: impl Iterator<Item = u64>,
    apart: &mut Vec<u64>,
) {
    for number in queries {
        let posed = mixed.posed(number);
        let [a, b] = [0, 1].map(|k| mixed.moving(&posed, k));
        solver.set_config(posed.config);
        let answer = solver.answer(a, b, 1.0).expect("a well-posed query");
        let triangles = [a, b]
            .iter()
            .all(|moving| moving.body.pieces().all_triangles());
        if !triangles {
            continue;
        }
        if let Outcome::Contact { .. } | Outcome::Free { .. } = answer.outcome {
            apart.push(number);
        }
    }
}

// One test: the count is that of all threads.
#[test]
fn queries_do_not_allocate_once_the_solver_is_warm() {
    let mixed = Mixed::new();
    assert_warm(&mixed, Direct::default());
    assert_warm(&mixed, Gjk);
}

/// Not counted: a search among bodies in contact at the start makes lists of its own, and [`Direct`] keeps a box
/// for each pair of hulls that is not in closed form.
fn assert_warm<O: DistanceOracle>(mixed: &Mixed, oracle: O) {
    let (mut apart, mut again) = (Vec::new(), Vec::with_capacity(QUERIES as usize));
    let mut solver = Solver::with_oracle(oracle);
    let cold = Region::new(HEAP);
    answer_all(mixed, &mut solver, 0..QUERIES, &mut apart);
    // The check can fail: the first round does allocate.
    assert!(cold.change().allocations > 0);
    assert!(apart.len() as u64 > QUERIES / 6, "{}", apart.len());
    let warm = Region::new(HEAP);
    answer_all(mixed, &mut solver, apart.iter().copied(), &mut again);
    let change = warm.change();
    assert_eq!(
        (change.allocations, change.reallocations),
        (0, 0),
        "{change:?}"
    );
    assert_eq!(again, apart);
}
