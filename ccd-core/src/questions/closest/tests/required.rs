//! Tests required distances above and below the least distance, and the bounds of searches that reach a limit.

use super::*;

#[test]
fn a_required_distance_is_kept_or_not_on_either_side_of_the_least() {
    let mut rng = rng(11);
    let (mut kept, mut violated, mut between) = (0, 0, 0);
    for number in 0..800 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 4], 12);
        let known = closest_approach_answer(&scene.problem()).outcome;
        let Some((lower, upper)) = known
            .nearest_contact()
            .map(|_| (known.lower(), known.upper()))
        else {
            continue;
        };
        let tolerance = scene.problem().tolerance;
        let found = sampled_least_distance(&scene.problem(), 64);
        let slack = 2.0 * scene.problem().rounding;
        for required in [
            0.0,
            0.5 * lower,
            lower - 2.0 * tolerance,
            0.5 * (lower + upper),
            upper + 2.0 * tolerance,
            2.0 * upper + tolerance,
        ] {
            if !(required >= 0.0) {
                continue;
            }
            scene.settings.clearance = Some(required);
            let problem = scene.problem();
            let answer = closest_approach_answer(&problem);
            let outcome = answer.outcome;
            assert!(
                outcome.lower() <= found + slack,
                "{number}: {outcome:?}, {found:e}"
            );
            match outcome.clearance_verdict(required) {
                ClearanceVerdict::Kept => {
                    kept += 1;
                    assert!(
                        found >= required - slack,
                        "{number}: {required:e}, {outcome:?}"
                    );
                    assert_eq!(
                        outcome.time(),
                        outcome.nearest_contact().map(|(time, _)| time)
                    );
                }
                ClearanceVerdict::Violated => {
                    violated += 1;
                    let time = outcome.time().expect("a time of what was seen");
                    let near = distance(&problem, time);
                    let seen = outcome.upper();
                    assert!(
                        near <= seen * (1.0 + 1e-9) + 1e-9 + slack,
                        "{number}: {outcome:?}"
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
        kept > 500 && violated > 500 && between > 100,
        "{kept} {violated} {between}"
    );
}

/// Tests that the decision about a required distance takes at most twice the work of a query for any contact with that
/// margin, and less than the closest approach.
#[test]
fn a_required_distance_costs_little_more_than_a_margin() {
    let mut rng = rng(12);
    let (mut required, mut margins, mut measured) = (0, 0, 0);
    for number in 0..300 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 3], 12);
        let known = closest_approach_answer(&scene.problem());
        let Outcome::LeastDistance { lower, contact, .. } = known.outcome else {
            continue;
        };
        for distance in [0.7 * lower, 1.5 * contact.separation.upper] {
            scene.settings.clearance = Some(distance);
            required += closest_approach_answer(&scene.problem())
                .stats
                .budgeted_work();
            scene.settings.margin = distance;
            let problem = scene.problem();
            let any = DepthFirst::default().any_contact_of(&problem, &mut ExhaustiveOracle);
            margins += any.stats.budgeted_work();
            measured += known.stats.budgeted_work();
            scene.settings.margin = 0.0;
            scene.settings.clearance = None;
            assert!(!matches!(any.outcome, Outcome::Unresolved(_)));
        }
    }
    assert!(required <= 2 * margins, "{required} {margins}");
    assert!(required < measured, "{required} {measured}");
}

#[test]
fn searches_that_end_early_know_a_part_of_the_distance() {
    let mut rng = rng(13);
    let (mut ended, mut proven) = (0, 0);
    for number in 0..400 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 3], 12);
        let whole = closest_approach_answer(&scene.problem());
        if !(whole.outcome.lower() > 0.01) {
            continue;
        }
        scene.settings.budget = whole.stats.budgeted_work() - 1;
        let problem = scene.problem();
        let answer = closest_approach_answer(&problem);
        let Outcome::Unresolved(Unresolved {
            lower,
            nearest_contact: nearest,
            ..
        }) = answer.outcome
        else {
            continue;
        };
        let found = sampled_least_distance(&problem, 64);
        assert!(
            lower <= found + problem.rounding,
            "{number}: {lower:e} of {found:e}"
        );
        assert!(lower <= answer.outcome.upper());
        ended += 1;
        proven += u32::from(lower > 0.0 && nearest.is_some());
    }
    assert!(ended > 100 && 2 * proven > ended, "{proven} of {ended}");
}
