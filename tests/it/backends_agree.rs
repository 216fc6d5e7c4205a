//! Every backend, schedule and kind of piece gives the same answer, within the tolerance.

use ccd_core::Outcome;
use ccd_tests::backends::for_each_setup;
use ccd_tests::referee::{Finding, Referee};
use ccd_tests::strategies::{cases, check_cases};
use std::cell::Cell;

#[test]
fn all_setups_agree_unless_the_distance_is_within_the_tolerance() {
    let (hits, misses) = (Cell::new(0), Cell::new(0));
    check_cases(200, cases(), |case| {
        let query = case.query();
        // A contact is right at distances up to the tolerance, and a free answer at distances above 0.
        let first = Referee::with_margin(&query, case.tolerance).finding();
        let last = Referee::new(&query).finding();
        let mut seen = Vec::new();
        for_each_setup(&query, &case.config(), |_, setup, answer| {
            seen.push((setup, answer.outcome));
        });
        let clear = match (first, last) {
            (Finding::Start, _) => None,
            (Finding::Free { .. }, _) => Some(&misses),
            (_, Finding::Hit { .. }) => Some(&hits),
            _ => None,
        };
        if let Some(count) = clear {
            count.set(count.get() + 1);
        }
        let same =
            |x: &Outcome, y: &Outcome| std::mem::discriminant(x) == std::mem::discriminant(y);
        let differs = seen.iter().find(|s| !same(&s.1, &seen[0].1));
        match differs {
            Some(other) if clear.is_some() => Err(format!("{:?}\nbut {other:?}", seen[0])),
            _ => Ok(()),
        }
    });
    assert!(hits.get() > 60 && misses.get() > 40, "{hits:?} {misses:?}");
}
