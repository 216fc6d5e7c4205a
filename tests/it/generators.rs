//! Tests that random cases cover every kind of outcome.

use ccd_tests::case::Case;
use ccd_tests::checks::Judge;
use ccd_tests::referee::Finding;
use ccd_tests::strategies::{cases, convex_cases, crowded_cases, runner, scaled_and_remote_cases};
use proptest::strategy::{Strategy, ValueTree};

#[test]
fn cases_hit_and_miss() {
    let shares = OutcomeCounts::count_outcomes(&cases());
    assert!(
        shares.hit_count >= 60 && shares.miss_count >= 50,
        "{shares:?}"
    );
    assert!(shares.undecided_count <= 2, "{shares:?}");
}

#[test]
fn convex_cases_hit_and_miss() {
    let shares = OutcomeCounts::count_outcomes(&convex_cases());
    assert!(
        shares.hit_count >= 60 && shares.miss_count >= 50,
        "{shares:?}"
    );
}

#[test]
fn crowded_cases_overlap() {
    let shares = OutcomeCounts::count_outcomes(&crowded_cases());
    assert!(
        shares.start_contact_count >= 50 && shares.nested_count >= 2 && shares.hit_count >= 20,
        "{shares:?}"
    );
}

#[test]
fn remote_cases_hit_and_miss() {
    let shares = OutcomeCounts::count_outcomes(&scaled_and_remote_cases());
    assert!(
        shares.hit_count >= 60 && shares.miss_count >= 50,
        "{shares:?}"
    );
}

/// The numbers of outcomes of each kind in 200 cases.
#[derive(Debug, Default)]
struct OutcomeCounts {
    hit_count: u32,
    miss_count: u32,
    start_contact_count: u32,
    nested_count: u32,
    graze_count: u32,
    undecided_count: u32,
}

impl OutcomeCounts {
    fn count_outcomes(strategy: &impl Strategy<Value = Case>) -> OutcomeCounts {
        let mut shares = OutcomeCounts::default();
        let mut runner = runner(1);
        for _ in 0..200 {
            let case = strategy.new_tree(&mut runner).expect("a case").current();
            let query = case.query();
            let judge = Judge::new(&query, &case.config());
            let share = match judge.finding() {
                _ if judge.are_nested() => &mut shares.nested_count,
                Finding::ContactAtStart => &mut shares.start_contact_count,
                Finding::Hit { .. } => &mut shares.hit_count,
                Finding::Free { .. } => &mut shares.miss_count,
                Finding::Graze { .. } => &mut shares.graze_count,
                Finding::Undecided { .. } => &mut shares.undecided_count,
            };
            *share += 1;
        }
        shares
    }
}
