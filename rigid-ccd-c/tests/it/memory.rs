//! Tests that queries do not allocate once the solver is warm.

use crate::support::{Random, empty_answer, moving, ok};
use rigid_ccd_c::*;

#[test]
fn warm_queries_do_not_allocate() {
    let mut random = Random::new(4);
    let (mesh, _) = crate::support::random_mesh(&mut random, 200);
    let solver = crate::support::solver(None);
    let motions: Vec<_> = (0..100)
        .map(|_| [random.motion(), random.motion()])
        .collect();
    let mut hits = 0;
    let mut round = || {
        for [a, b] in &motions {
            let (a, b) = (moving(&mesh, a), moving(&mesh, b));
            let mut answer = empty_answer();
            // SAFETY: all pointers are to values that live here.
            ok(unsafe { rccd_first_contact(solver.pointer(), &a, &b, 1.0, &mut answer) });
            hits += i32::from(answer.outcome == RccdOutcome::Contact);
        }
    };
    round();
    let counted = allocation_counter::measure(round);
    assert_eq!(counted.count_total, 0, "{counted:?}");
    assert!(hits > 20, "{hits}");
}
