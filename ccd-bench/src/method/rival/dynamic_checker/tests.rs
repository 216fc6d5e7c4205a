use super::DynamicChecker;
use crate::method::rival::tests::trials::{
    assert_exact_scenes, assert_gives_up, assert_shots, hovering, knot_216,
};
use crate::method::solver::{Claim, Solver};
use ccd_core::glam::DVec3;
use ccd_core::{Motion, Pose};

#[test]
fn exact_times_are_met() {
    for tolerance in [1e-3, 1e-6, 1e-9] {
        assert_exact_scenes(tolerance, |a, b| DynamicChecker::new(a, b, tolerance));
    }
}

#[test]
fn shots_are_neither_missed_nor_late_nor_early() {
    for tolerance in [1e-2, 1e-5] {
        let mut rival = DynamicChecker::new(&knot_216(), &knot_216(), tolerance);
        assert_shots(tolerance, &mut rival);
    }
}

#[test]
fn work_without_end_is_given_up() {
    assert_gives_up(
        |a, b| DynamicChecker::new(a, b, 1e-6),
        |rival, patience| rival.patience = patience,
    );
}

#[test]
fn motions_beyond_numbers_are_given_up() {
    let (a, b, mut query) = hovering();
    query.a = Motion::new(Pose::IDENTITY, DVec3::ZERO, 1e308 * DVec3::Z).unwrap();
    query.duration = 1e10;
    let reply = DynamicChecker::new(&a, &b, 1e-3).answer(&query);
    assert_eq!(reply.claim, Claim::Unresolved { safe_until: 0.0 });
}
