//! Compares answers about any contact with first contacts and sampled distances, for every budget and for an oracle of
//! false claims.

use super::*;
use crate::answer::Unresolved;
use crate::body::Body;
use crate::body::Solidity;
use crate::body::piece::ConvexCombination;
use crate::distance::oracle::{Claim, GiveUpReason, PiecePair};
use crate::engine::answer::EngineSchedule;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::schedule::BestFirst;
use crate::settings::{Settings, StartPolicy};
use crate::tests::meshes::cube;
use crate::tests::oracle::{ConstantOracle, ExhaustiveOracle};
use crate::tests::scene::{RngExt, SceneKind, distance, pieces, random_direction, rng, scene};

const SCENE_KINDS: [SceneKind; 4] = [
    SceneKind::RandomMotion,
    SceneKind::Sliding,
    SceneKind::NearRim,
    SceneKind::Receding,
];

fn any_contact_outcome(problem: &Problem<'_>) -> Outcome {
    let mut schedule = DepthFirst::default();
    schedule
        .any_contact_of(problem, &mut ExhaustiveOracle)
        .outcome
}

fn first(problem: &Problem<'_>) -> Outcome {
    BestFirst::default()
        .answer_first_contact(problem, &mut ExhaustiveOracle)
        .outcome
}

#[test]
fn there_is_any_contact_where_there_is_a_first_one() {
    let mut rng = rng(1);
    let (mut hits, mut misses, mut starts, mut later, mut grazes) = (0, 0, 0, 0, 0);
    for number in 0..2_000 {
        let scene =
            scene(&mut rng, SCENE_KINDS[number % 4], 12).with_occasional_accelerations(&mut rng);
        let problem = scene.problem();
        let within = problem.contact_distance();
        match (any_contact_outcome(&problem), first(&problem)) {
            (Outcome::Contact { time, contact }, Outcome::Contact { time: first, .. }) => {
                hits += 1;
                later += u32::from(time > first);
                // Neither contact is much earlier than the other is certain.
                assert!(time >= first || distance(&problem, time) <= within + problem.rounding);
                assert!(contact.separation.upper <= within, "{number}: {contact:?}");
                assert!(distance(&problem, time) <= within + problem.rounding);
            }
            (Outcome::Free { proven_gap }, Outcome::Free { .. }) => {
                misses += 1;
                for k in 0..=32 {
                    let found = distance(&problem, f64::from(k) / 32.0);
                    assert!(
                        found >= proven_gap - problem.rounding,
                        "{number}: {found:e}"
                    );
                }
            }
            (
                Outcome::Contact { time, .. },
                Outcome::Touching { .. } | Outcome::Overlapping { .. },
            ) => {
                starts += 1;
                assert!(distance(&problem, time) <= within + problem.rounding);
            }
            (Outcome::Overlapping { .. }, Outcome::Overlapping { .. }) => starts += 1,
            // The least distance is within the tolerance, but not within half of it: both answers are right.
            (Outcome::Free { .. }, Outcome::Contact { time, .. })
            | (Outcome::Contact { time, .. }, Outcome::Free { .. }) => {
                grazes += 1;
                let near = distance(&problem, time);
                assert!(
                    near >= problem.kept_gap() - problem.rounding,
                    "{number}: {near:e}"
                );
            }
            (any, first) => panic!("{number}: {any:?}, {first:?}"),
        }
    }
    assert!(hits > 100 && misses > 100, "{hits} {misses}");
    assert!(starts > 5 && later > 25, "{starts} {later}");
    assert!(grazes < 5, "{grazes}");
}

#[test]
fn bodies_that_are_let_go_have_the_verdict_of_the_first_contact() {
    let mut rng = rng(2);
    let (mut free, mut contacts) = (0, 0);
    for number in 0..600 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 4], 6);
        scene.settings.start_policy = StartPolicy::Leave;
        let problem = scene.problem();
        match (any_contact_outcome(&problem), first(&problem)) {
            (Outcome::Free { .. }, Outcome::Free { .. }) => free += 1,
            (Outcome::Contact { .. }, Outcome::Contact { .. }) => contacts += 1,
            (Outcome::Overlapping { .. }, Outcome::Overlapping { .. }) => {}
            (Outcome::Unresolved(_), Outcome::Unresolved(_)) => {}
            (any, first) => panic!("{number}: {any:?}, {first:?}"),
        }
    }
    assert!(free > 200 && contacts > 20, "{free} {contacts}");
}

#[test]
fn budgets_end_a_search_with_a_time_that_is_safe() {
    let mut rng = rng(3);
    let mut ended = 0;
    for number in 0..200 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 3], 12);
        let touch = match first(&scene.problem()) {
            Outcome::Contact { time, .. } => time,
            Outcome::Free { .. } => 1.0,
            _ => continue,
        };
        for budget in 0..40 {
            scene.settings.budget = budget;
            match any_contact_outcome(&scene.problem()) {
                Outcome::Unresolved(Unresolved {
                    safe_until,
                    limit: reason,
                    ..
                }) => {
                    assert_eq!(reason, Limit::Budget);
                    assert!(safe_until <= touch, "{number}: {safe_until} of {touch}");
                    ended += 1;
                }
                _ => break,
            }
        }
    }
    assert!(ended > 500, "{ended}");
}

#[test]
fn false_claims_and_give_ups_never_make_bodies_free() {
    let mut rng = rng(4);
    let (mut unresolved, mut others) = (0, 0);
    for number in 0..400 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 3], 8);
        scene.settings.budget = 20_000;
        let problem = scene.problem();
        let touch = (0..=64)
            .map(|k| f64::from(k) / 64.0)
            .find(|&s| distance(&problem, s) <= 0.0);
        let lie = Claim {
            axis: random_direction(&mut rng),
            a: ConvexCombination::from_single_point(rng.random_range(0..5)),
            b: ConvexCombination::from_single_point(rng.random_range(0..5)),
        };
        for oracle in [
            ConstantOracle(Ok(lie)),
            ConstantOracle(Err(GiveUpReason::Cycle)),
        ] {
            let answer = DepthFirst::default().any_contact_of(&problem, &mut { oracle });
            match answer.outcome {
                Outcome::Unresolved(Unresolved { safe_until, .. }) => {
                    unresolved += 1;
                    assert!(touch.is_none_or(|touch| safe_until <= touch));
                }
                Outcome::Free { .. } => {
                    others += 1;
                    assert_eq!(touch, None);
                }
                Outcome::Contact { time, .. } => {
                    others += 1;
                    let near = distance(&problem, time);
                    assert!(near <= problem.contact_distance() + problem.rounding);
                }
                Outcome::Overlapping { .. } => {}
                other => panic!("no outcome of any contact: {other:?}"),
            }
        }
    }
    assert!(unresolved > 50 && others > 50, "{unresolved} {others}");
}

/// An oracle that gives up after a given number of calls.
struct LimitedOracle {
    calls_left: usize,
}

impl DistanceOracle for LimitedOracle {
    type Cache = ();

    fn separation(&mut self, pair: &PiecePair<'_>, (): &mut ()) -> Result<Claim, GiveUpReason> {
        let left = self.calls_left.checked_sub(1);
        self.calls_left = left.ok_or(GiveUpReason::BadFacets)?;
        ExhaustiveOracle.separation(pair, &mut ())
    }
}

/// Tests that a search that reaches a limit certifies no time if one body starts inside a solid body.
#[test]
fn a_body_inside_a_solid_is_never_certified_apart() {
    let outer = Body::new(&pieces(&cube(1.0, 1)), Solidity::Solid).unwrap();
    let inner = Body::new(&pieces(&cube(0.1, 1)), Solidity::Solid).unwrap();
    let start = Pose::at([0.05, 0.02, 0.01]).unwrap();
    let (mut early, mut inside) = (0, 0);
    for speed in [0.1, 3.0] {
        let leaving = Motion::new(start, [speed, 0.2, 0.1], [0.0, 1.0, 4.0]).unwrap();
        for limit in 0..60 {
            for (budget, calls_left) in [(limit, usize::MAX), (u64::MAX, limit as usize)] {
                let config = Settings {
                    budget,
                    tolerance: 1e-2,
                    ..Settings::DEFAULT
                };
                let bodies = [(&inner, leaving), (&outer, Motion::STILL)];
                let problem = Problem::new(bodies, 1.0, &config.to_query_settings()).unwrap();
                let mut schedule = DepthFirst::default();
                let answer = schedule.any_contact_of(&problem, &mut LimitedOracle { calls_left });
                match answer.outcome {
                    Outcome::Unresolved(ended) => {
                        early += 1;
                        assert_eq!(ended.safe_until, 0.0, "{speed} {budget} {calls_left}");
                    }
                    // A contact of the surfaces is found later, and nothing is claimed about the time before.
                    Outcome::Contact { .. } => {}
                    Outcome::Overlapping { .. } => inside += 1,
                    other => panic!("{speed} {budget} {calls_left}: {other:?}"),
                }
            }
        }
    }
    assert!(early > 5 && inside > 20, "{early} {inside}");
}

#[test]
fn answers_do_not_depend_on_earlier_searches() {
    let mut rng = rng(5);
    let mut kept = DepthFirst::default();
    for number in 0..200 {
        let scene = scene(&mut rng, SCENE_KINDS[number % 4], 12);
        let problem = scene.problem();
        let fresh = DepthFirst::default().any_contact_of(&problem, &mut ExhaustiveOracle);
        assert_eq!(kept.any_contact_of(&problem, &mut ExhaustiveOracle), fresh);
        kept.closest_approach_of(&problem, &mut ExhaustiveOracle);
        assert_eq!(kept.any_contact_of(&problem, &mut ExhaustiveOracle), fresh);
    }
}
