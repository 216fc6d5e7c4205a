use super::C2a;
use crate::method::rival::tests::trials::{
    assert_contact_times_within_tolerance, assert_shots_are_conservative,
    assert_stops_at_work_limit, knot_216,
};

#[test]
fn exact_times_are_met() {
    for tolerance in [1e-3, 1e-6, 1e-9] {
        assert_contact_times_within_tolerance(tolerance, C2a::new);
    }
}

#[test]
fn shots_are_neither_missed_nor_late_nor_early() {
    for tolerance in [1e-2, 1e-5] {
        let mut rival = C2a::new(&knot_216(), &knot_216());
        assert_shots_are_conservative(tolerance, &mut rival);
    }
}

#[test]
fn work_without_end_is_given_up() {
    assert_stops_at_work_limit(C2a::new, |rival, patience| rival.work_limit = patience);
}
