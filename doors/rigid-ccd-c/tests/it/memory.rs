//! Tests that queries do not allocate once the solver is warm.

use crate::support::{Handle, Random, default_settings, empty_answer, moving, ok};
use rigid_ccd_c::*;

/// Asks for the first contact of a body with a copy of itself, on each of the motions. Returns the number of contacts.
fn ask_all(
    solver: &Handle<RccdSolver>,
    mesh: &Handle<RccdBody>,
    motions: &[[RccdMotion; 2]],
) -> usize {
    let is_hit = |[a, b]: &[RccdMotion; 2]| {
        let (a, b) = (moving(mesh, a), moving(mesh, b));
        let mut answer = empty_answer();
        // SAFETY: all pointers are to values that live here.
        ok(unsafe { rccd_first_contact(solver.pointer(), &a, &b, 1.0, &mut answer) });
        answer.outcome == RccdOutcome::Contact
    };
    motions.iter().filter(|row| is_hit(row)).count()
}

#[test]
fn warm_queries_do_not_allocate() {
    let mut random = Random::new(4);
    let (mesh, _) = crate::support::random_mesh(&mut random, 200);
    let motions: Vec<_> = (0..200)
        .map(|_| [random.motion(), random.motion()])
        .collect();
    let of_pieces = RccdSettings {
        contact_normals: RccdContactNormals::OfPieces as u32,
        ..default_settings()
    };
    for settings in [default_settings(), of_pieces] {
        let solver = crate::support::solver(Some(&settings));
        ask_all(&solver, &mesh, &motions);
        let mut hits = 0;
        let counted = allocation_counter::measure(|| hits = ask_all(&solver, &mesh, &motions));
        assert_eq!(counted.count_total, 0, "{counted:?}");
        assert!(hits > 20, "{hits}");
    }
}
