use super::C2a;
use crate::contender::{Claim, Contender};
use crate::rival::patience::Patience;
use crate::rival::trials::{assert_exact_scenes, assert_shots, hovering, knot_216};

#[test]
fn exact_times_are_met() {
    for tolerance in [1e-3, 1e-6, 1e-9] {
        assert_exact_scenes(tolerance, |a, b| C2a::new(a, b, tolerance));
    }
}

#[test]
fn shots_are_neither_missed_nor_late_nor_early() {
    for tolerance in [1e-2, 1e-5] {
        let mut rival = C2a::new(&knot_216(), &knot_216(), tolerance);
        assert_shots(tolerance, &mut rival);
    }
}

#[test]
fn work_without_end_is_given_up() {
    let (a, b, query) = hovering();
    let mut rival = C2a::new(&a, &b, 1e-6);
    assert_eq!(rival.answer(&query).claim, Claim::Free);
    for patience in [
        Patience {
            steps: 20,
            ..Patience::default()
        },
        Patience {
            pairs: 1_000,
            ..Patience::default()
        },
    ] {
        rival.patience = patience;
        let Claim::Unresolved { safe_until } = rival.answer(&query).claim else {
            panic!("{patience:?} was enough");
        };
        assert!(
            0.0 < safe_until && safe_until < query.duration,
            "{safe_until}"
        );
    }
}
