//! Tests that random cases cover every kind of outcome.

use ccd_tests::case::Case;
use ccd_tests::checks::Judge;
use ccd_tests::referee::Finding;
use ccd_tests::strategies::{cases, convex_cases, crowded_cases, runner, scaled_and_remote_cases};
use proptest::strategy::{Strategy, ValueTree};

#[test]
fn cases_hit_and_miss() {
    let fractions = OutcomeCounts::count_outcomes(&cases());
    assert!(
        fractions.hit_count >= 60 && fractions.miss_count >= 50,
        "{fractions:?}"
    );
    assert!(fractions.undecided_count <= 2, "{fractions:?}");
}

#[test]
fn convex_cases_hit_and_miss() {
    let fractions = OutcomeCounts::count_outcomes(&convex_cases());
    assert!(
        fractions.hit_count >= 60 && fractions.miss_count >= 50,
        "{fractions:?}"
    );
}

#[test]
fn crowded_cases_overlap() {
    let fractions = OutcomeCounts::count_outcomes(&crowded_cases());
    assert!(
        fractions.start_contact_count >= 50
            && fractions.nested_count >= 2
            && fractions.hit_count >= 20,
        "{fractions:?}"
    );
}

#[test]
fn remote_cases_hit_and_miss() {
    let fractions = OutcomeCounts::count_outcomes(&scaled_and_remote_cases());
    assert!(
        fractions.hit_count >= 60 && fractions.miss_count >= 50,
        "{fractions:?}"
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
        let mut fractions = OutcomeCounts::default();
        let mut runner = runner(1);
        for _ in 0..200 {
            let case = strategy.new_tree(&mut runner).expect("a case").current();
            let query = case.query();
            let judge = Judge::new(&query, &case.config());
            let fraction = match judge.finding() {
                _ if judge.are_nested() => &mut fractions.nested_count,
                Finding::ContactAtStart => &mut fractions.start_contact_count,
                Finding::Hit { .. } => &mut fractions.hit_count,
                Finding::Free { .. } => &mut fractions.miss_count,
                Finding::Graze { .. } => &mut fractions.graze_count,
                Finding::Undecided { .. } => &mut fractions.undecided_count,
            };
            *fraction += 1;
        }
        fractions
    }
}
