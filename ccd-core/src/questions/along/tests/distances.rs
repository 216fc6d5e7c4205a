//! Tests required clearances and least distances along trajectories, and the bounds of searches that reach a limit.

use super::*;
use crate::answer::ClearanceVerdict;
use crate::answer::Limit;
use crate::answer::Unresolved;

/// Returns the least of the distances sampled at equal time steps, which are so short that distances in between hardly
/// differ.
fn sampled_least_distance(swings: &SwingingBodies) -> f64 {
    let distances = (0..=200).map(|k| swings.distance(f64::from(k) / 200.0));
    distances.fold(f64::INFINITY, lesser)
}

#[test]
fn a_required_distance_is_kept_or_not_on_either_side_of_the_least() {
    let mut rng = rng(21);
    let (mut kept, mut violated, mut between) = (0, 0, 0);
    for number in 0..200 {
        let mut swings = SwingingBodies::draw(&mut rng);
        let tolerance = swings.settings.tolerance;
        let least = sampled_least_distance(&swings);
        let ask = |swings: &SwingingBodies| {
            let query = swings.query();
            let answer = DepthFirst::default().closest_approach(&query, &mut ExhaustiveOracle);
            answer.unwrap().outcome
        };
        let known = ask(&swings);
        if known.nearest_contact().is_none() {
            continue;
        }
        let (lower, upper) = (known.lower(), known.upper());
        for required in [
            0.5 * lower,
            lower - 2.0 * tolerance,
            0.5 * (lower + upper),
            upper + 2.0 * tolerance,
            upper + 0.2,
        ] {
            if !(required >= 0.0) {
                continue;
            }
            swings.settings.clearance = Some(required);
            let outcome = ask(&swings);
            assert!(
                outcome.lower() <= least + ROUNDING,
                "{number}: {outcome:?}, {least:e}"
            );
            match outcome.clearance_verdict(required) {
                ClearanceVerdict::Kept => kept += 1,
                ClearanceVerdict::Violated => {
                    violated += 1;
                    let near = swings.distance(outcome.time().unwrap());
                    assert!(
                        near <= outcome.upper() + ROUNDING,
                        "{number}: {outcome:?}, {near:e}"
                    );
                }
                ClearanceVerdict::Unverified => {
                    between += 1;
                    assert!(
                        required <= upper + 1.1 * tolerance && required >= lower - 1.1 * tolerance,
                        "{number}: {required:e} beside {known:?}: {outcome:?}"
                    );
                }
            }
        }
    }
    assert!(
        kept > 60 && violated > 100 && between > 40,
        "{kept} {violated} {between}"
    );
}

#[test]
fn budgets_end_a_search_with_bounds_that_hold() {
    let mut rng = rng(22);
    let (mut ended, mut proven) = (0, 0);
    for number in 0..100 {
        let mut swings = SwingingBodies::draw(&mut rng);
        let least = sampled_least_distance(&swings);
        let query = swings.query();
        let whole = DepthFirst::default().closest_approach(&query, &mut ExhaustiveOracle);
        let work = whole.unwrap().stats.budgeted_work();
        for share in [0.1, 0.5, 0.9] {
            swings.settings.budget = (share * work as f64) as u64 + 1;
            let query = swings.query();
            let answer = DepthFirst::default().closest_approach(&query, &mut ExhaustiveOracle);
            let outcome = answer.unwrap().outcome;
            assert!(
                outcome.lower() <= least + ROUNDING,
                "{number}: {outcome:?}, {least:e}"
            );
            if let Outcome::Unresolved(Unresolved {
                lower,
                limit: reason,
                ..
            }) = outcome
            {
                assert_eq!(reason, Limit::Budget);
                ended += 1;
                proven += u32::from(lower > 0.0);
            }
        }
    }
    assert!(ended > 60 && 4 * proven > ended, "{proven} of {ended}");
}
