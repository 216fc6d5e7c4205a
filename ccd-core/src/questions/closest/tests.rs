//! Compares bounds of the least distance with sampled distances, for every budget and for an oracle of false claims.

mod conforming;
mod excess;
mod required;

use super::*;
use crate::answer::ClearanceVerdict;
use crate::body::Body;
use crate::body::piece::ConvexCombination;
use crate::distance::oracle::{Claim, GiveUpReason};
use crate::engine::answer::EngineSchedule;
use crate::math::order::lesser;
use crate::motion::Motion;
use crate::schedule::BestFirst;
use crate::settings::Settings;
use crate::tests::oracle::{ConstantOracle, ExhaustiveOracle};
use crate::tests::scene::{
    RngExt, SceneKind, body, distance, random_direction, random_power_of_ten, rng, scene, sheet,
};
use std::f64::consts::TAU;

const SCENE_KINDS: [SceneKind; 4] = [
    SceneKind::RandomMotion,
    SceneKind::Sliding,
    SceneKind::NearRim,
    SceneKind::Receding,
];

fn closest_approach_answer(problem: &Problem<'_>) -> Answer {
    DepthFirst::default().closest_approach_of(problem, &mut ExhaustiveOracle)
}

/// Returns the least of the distances sampled at equal time steps.
fn sampled_least_distance(problem: &Problem<'_>, steps: u32) -> f64 {
    let at = |k| distance(problem, f64::from(k) / f64::from(steps));
    (0..=steps).map(at).fold(f64::INFINITY, lesser)
}

#[test]
fn brackets_hold_the_least_of_sampled_distances_and_are_narrow() {
    let mut rng = rng(1);
    let (mut apart, mut touching, mut overlapping) = (0, 0, 0);
    for number in 0..1_000 {
        let mut scene =
            scene(&mut rng, SCENE_KINDS[number % 4], 12).with_occasional_accelerations(&mut rng);
        scene.settings.tolerance *= random_power_of_ten(&mut rng, -4.0, 0.0);
        let problem = scene.problem();
        let Answer {
            outcome, tolerance, ..
        } = closest_approach_answer(&problem);
        let slack = 2.0 * problem.rounding;
        let found = sampled_least_distance(&problem, 64);
        match outcome {
            Outcome::LeastDistance {
                lower,
                time,
                contact,
            } => {
                let upper = outcome.upper();
                assert!(upper - lower <= tolerance, "{number}: {outcome:?}");
                assert!(
                    tolerance <= 2.0 * problem.tolerance,
                    "{number}: {tolerance:e}"
                );
                assert!(found >= lower - slack, "{number}: {found:e} in {outcome:?}");
                let near = distance(&problem, time);
                // The reference finds common points of crossing needles with some error only.
                let cross = contact.separation.lower < -slack;
                assert!(
                    cross || near <= upper + 1e-9 * near + slack,
                    "{number}: {near:e} in {outcome:?}"
                );
                assert!(contact.separation.lower <= lower);
                if lower > 0.0 {
                    apart += 1;
                } else {
                    touching += 1;
                }
            }
            Outcome::Overlapping { .. } => {
                overlapping += 1;
                assert!(distance(&problem, 0.0) <= slack);
            }
            outcome => panic!("{number}: {outcome:?}"),
        }
    }
    assert!(
        apart > 80 && touching > 80 && overlapping > 0,
        "{apart} {touching} {overlapping}"
    );
}

/// Tests that a query has a contact if its margin is the upper bound of the least distance, and none if its margin is a
/// little below the lower bound.
#[test]
fn bodies_are_free_with_less_than_the_bracket_as_a_margin_and_meet_with_more() {
    let mut rng = rng(2);
    let mut compared = 0;
    for number in 0..600 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 3], 12);
        let Answer {
            outcome, tolerance, ..
        } = closest_approach_answer(&scene.problem());
        let Outcome::LeastDistance { lower, .. } = outcome else {
            continue;
        };
        let mut at = |margin: f64| {
            scene.settings.margin = margin;
            BestFirst::default()
                .answer_first_contact(&scene.problem(), &mut ExhaustiveOracle)
                .outcome
        };
        if lower > 2.0 * tolerance {
            compared += 1;
            let less = at(lower - 2.0 * tolerance);
            assert!(matches!(less, Outcome::Free { .. }), "{number}: {less:?}");
        }
        let more = at(outcome.upper());
        assert!(!matches!(more, Outcome::Free { .. }), "{number}: {more:?}");
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn a_clearance_is_kept_violated_or_unknown() {
    let mut rng = rng(3);
    for number in 0..200 {
        let scene = scene(&mut rng, SCENE_KINDS[number % 3], 8);
        let outcome = closest_approach_answer(&scene.problem()).outcome;
        let (lower, upper) = (outcome.lower(), outcome.upper());
        assert_eq!(
            outcome.clearance_verdict(upper.next_up()),
            ClearanceVerdict::Violated
        );
        assert_ne!(outcome.clearance_verdict(f64::NAN), ClearanceVerdict::Kept);
        // Bodies that may touch keep no clearance.
        if lower > 0.0 {
            assert_eq!(outcome.clearance_verdict(lower), ClearanceVerdict::Kept);
        } else {
            assert_ne!(outcome.clearance_verdict(0.0), ClearanceVerdict::Kept);
        }
        if lower < upper {
            let between = 0.5 * (lower + upper);
            assert_eq!(
                outcome.clearance_verdict(between),
                ClearanceVerdict::Unverified
            );
        }
    }
}

#[test]
fn budgets_end_a_search_with_what_was_seen() {
    let mut rng = rng(4);
    let (mut ended, mut seen, mut proven) = (0, 0, 0);
    for number in 0..100 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 3], 12);
        let (visits, least) = {
            let answer = closest_approach_answer(&scene.problem());
            (answer.stats.iterations, answer.outcome.lower())
        };
        let found = sampled_least_distance(&scene.problem(), 64);
        for budget in 0..visits.min(60) {
            scene.settings.budget = budget;
            let problem = scene.problem();
            let outcome = closest_approach_answer(&problem).outcome;
            let Outcome::Unresolved(Unresolved {
                lower,
                nearest_contact: nearest,
                limit: reason,
                ..
            }) = outcome
            else {
                panic!("{number}: {outcome:?} for {budget} of {visits}");
            };
            assert_eq!(reason, Limit::Budget);
            assert!(lower <= found + problem.rounding, "{number}: {outcome:?}");
            ended += 1;
            proven += u32::from(lower > 0.0);
            if let Some((time, contact)) = nearest {
                seen += 1;
                let near = distance(&problem, time);
                assert!(near <= contact.separation.upper * (1.0 + 1e-9) + 2.0 * problem.rounding);
                assert!(outcome.upper() >= least);
            }
        }
    }
    assert!(
        ended > 1_000 && seen > 200 && proven > 200,
        "{ended} {seen} {proven}"
    );
}

#[test]
fn false_claims_and_give_ups_never_raise_the_lower_bound() {
    let mut rng = rng(5);
    let (mut unresolved, mut others) = (0, 0);
    for number in 0..300 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 3], 8);
        scene.settings.budget = 20_000;
        let problem = scene.problem();
        let found = sampled_least_distance(&problem, 64);
        let lie = Claim {
            axis: random_direction(&mut rng),
            a: ConvexCombination::from_single_point(rng.random_range(0..5)),
            b: ConvexCombination::from_single_point(rng.random_range(0..5)),
        };
        for oracle in [
            ConstantOracle(Ok(lie)),
            ConstantOracle(Err(GiveUpReason::Cycle)),
        ] {
            let answer = DepthFirst::default().closest_approach_of(&problem, &mut { oracle });
            let outcome = answer.outcome;
            assert!(
                outcome.lower() <= found + problem.rounding,
                "{number}: {outcome:?}"
            );
            match outcome {
                Outcome::Unresolved(_) => unresolved += 1,
                _ => others += 1,
            }
        }
    }
    assert!(unresolved > 50 && others > 20, "{unresolved} {others}");
}

#[test]
fn answers_do_not_depend_on_earlier_searches() {
    let mut rng = rng(6);
    let mut kept = DepthFirst::default();
    for number in 0..200 {
        let scene = scene(&mut rng, SCENE_KINDS[number % 4], 12);
        let problem = scene.problem();
        let fresh = closest_approach_answer(&problem);
        assert_eq!(
            kept.closest_approach_of(&problem, &mut ExhaustiveOracle),
            fresh
        );
        assert_eq!(
            kept.closest_approach_of(&problem, &mut ExhaustiveOracle),
            fresh
        );
    }
}

#[test]
fn bodies_at_rest_have_a_distance() {
    let mut rng = rng(7);
    let (mut apart, mut overlapping) = (0, 0);
    for number in 0..1_000 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 4], 12);
        let clock = scene.clock;
        scene.motions = scene
            .motions
            .map(|motion| Motion::still(motion.pose(clock)));
        let problem = scene.problem();
        let outcome = closest_approach_answer(&problem).outcome;
        let found = distance(&problem, 0.0);
        let slack = 2.0 * problem.rounding;
        match outcome {
            Outcome::LeastDistance { lower, contact, .. } => {
                apart += 1;
                let upper = contact.separation.upper;
                assert!(lower <= found + slack && found <= upper * (1.0 + 1e-9) + slack);
                // The bracket is as exact as f64 allows, whatever the tolerance.
                assert!(
                    upper - lower <= 2e-5 * upper + 2.0 * slack,
                    "{number}: {outcome:?}"
                );
            }
            Outcome::Overlapping { .. } => {
                overlapping += 1;
                assert!(found <= slack, "{number}: {found:e}");
            }
            // A corner is on a face, up to rounding.
            Outcome::Unresolved(Unresolved { limit: reason, .. }) => {
                assert_eq!(reason, Limit::OverlapUndecided);
                assert!(found <= slack, "{number}: {found:e}");
            }
            outcome => panic!("{number}: {outcome:?}"),
        }
    }
    assert!(apart > 100 && overlapping > 10, "{apart} {overlapping}");
}

/// Returns a sphere of triangles, open at its poles.
fn open_sphere(radius: f64, rings: usize, sectors: usize) -> Body {
    body(&sheet(rings, sectors, |u, v| {
        let ((s, c), (y, x)) = ((3.0 * u + 0.07).sin_cos(), (v * TAU).sin_cos());
        [radius * s * x, radius * s * y, radius * c]
    }))
}

#[test]
fn the_work_of_a_distance_does_not_depend_on_the_unit_of_length() {
    let visits = [1.0, 1024.0, 1.0 / 1024.0].map(|unit| {
        let [outer, inner] = [open_sphere(1.6 * unit, 24, 20), open_sphere(unit, 12, 8)];
        let settings = Settings {
            tolerance: 1e-6 * unit,
            ..Settings::DEFAULT
        };
        let problem = Problem::of_moving_bodies(
            (&outer, Motion::STILL),
            (&inner, Motion::STILL),
            1.0,
            &settings,
        );
        closest_approach_answer(&problem.unwrap()).stats.iterations
    });
    let [one, large, small] = visits;
    assert!(one > 500, "{visits:?}");
    for other in [large, small] {
        assert!(other.abs_diff(one) * 50 <= one, "{visits:?}");
    }
}
