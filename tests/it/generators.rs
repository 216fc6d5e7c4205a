//! Tests that random cases cover every kind of outcome.

use ccd_tests::case::Case;
use ccd_tests::checks::Judge;
use ccd_tests::referee::Finding;
use ccd_tests::strategies::{cases, convex_cases, crowded_cases, remote_cases, runner};
use proptest::strategy::{Strategy, ValueTree};

#[test]
fn cases_hit_and_miss() {
    let shares = OutcomeCounts::count(&cases());
    assert!(shares.hits >= 60 && shares.misses >= 50, "{shares:?}");
    assert!(shares.undecided <= 2, "{shares:?}");
}

#[test]
fn convex_cases_hit_and_miss() {
    let shares = OutcomeCounts::count(&convex_cases());
    assert!(shares.hits >= 60 && shares.misses >= 50, "{shares:?}");
}

#[test]
fn crowded_cases_overlap() {
    let shares = OutcomeCounts::count(&crowded_cases());
    assert!(
        shares.starts >= 50 && shares.nested >= 2 && shares.hits >= 20,
        "{shares:?}"
    );
}

#[test]
fn remote_cases_hit_and_miss() {
    let shares = OutcomeCounts::count(&remote_cases());
    assert!(shares.hits >= 60 && shares.misses >= 50, "{shares:?}");
}

/// The numbers of outcomes of each kind in 200 cases.
#[derive(Debug, Default)]
struct OutcomeCounts {
    hits: u32,
    misses: u32,
    starts: u32,
    nested: u32,
    near: u32,
    undecided: u32,
}

impl OutcomeCounts {
    fn count(strategy: &impl Strategy<Value = Case>) -> OutcomeCounts {
        let mut shares = OutcomeCounts::default();
        let mut runner = runner(1);
        for _ in 0..200 {
            let case = strategy.new_tree(&mut runner).expect("a case").current();
            let query = case.query();
            let judge = Judge::new(&query, &case.config());
            let share = match judge.finding() {
                _ if judge.nested() => &mut shares.nested,
                Finding::Start => &mut shares.starts,
                Finding::Hit { .. } => &mut shares.hits,
                Finding::Free { .. } => &mut shares.misses,
                Finding::Near { .. } => &mut shares.near,
                Finding::Undecided { .. } => &mut shares.undecided,
            };
            *share += 1;
        }
        shares
    }
}
