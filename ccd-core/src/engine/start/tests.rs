//! Compares answers for bodies that begin within the margin with all pairs of triangles, for every schedule and many
//! budgets.

use crate::answer::{Answer, Limit, Outcome, Unresolved};
use crate::body::Body;
use crate::body::piece::ConvexCombination;
use crate::distance::oracle::{Claim, GiveUpReason};
use crate::engine::answer::EngineSchedule;
use crate::math::order::lesser;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::query::MovingBody;
use crate::rounding::SKIPPED_PAIR_ALLOWANCE;
#[cfg(feature = "hull-tree")]
use crate::schedule::Fast;
use crate::schedule::{BestFirst, Naive};
use crate::settings::{Settings, StartPolicy};
use crate::tests::meshes::torus;
use crate::tests::oracle::{ConstantOracle, ExhaustiveOracle};
use crate::tests::scene::{
    Pcg64, RngExt, Scene, SceneKind, body, distance, random_power_of_ten, rng, scene,
};
use glam::DVec3;
use std::time::Duration;

/// Returns one solver for each schedule.
fn schedules() -> Vec<Box<dyn EngineSchedule<ExhaustiveOracle>>> {
    vec![
        Box::new(BestFirst::default()),
        Box::new(Naive::default()),
        #[cfg(feature = "hull-tree")]
        Box::new(Fast::default()),
    ]
}

fn solve(problem: &Problem<'_>) -> Answer {
    BestFirst::default().answer_first_contact(problem, &mut ExhaustiveOracle)
}

/// Calls `then` with the problem of two equal tori at rest, one at `x`, the other at the origin.
fn with_two_tori<R>(
    cuts: TorusSegments,
    x: f64,
    config: &Settings,
    then: impl FnOnce(&Problem<'_>) -> R,
) -> R {
    let torus = body(&torus(cuts.segments_around_axis, cuts.segments_around_tube));
    let moving =
        |x: f64| MovingBody::from((&torus, Motion::still(Pose::at(x * DVec3::X).unwrap())));
    then(&Problem::of_moving_bodies(moving(x), moving(0.0), 1.0, config).unwrap())
}

/// The numbers of segments of a torus around its axis and around its tube.
#[derive(Clone, Copy)]
struct TorusSegments {
    segments_around_axis: usize,
    segments_around_tube: usize,
}

const FINE_SEGMENTS: TorusSegments = TorusSegments {
    segments_around_axis: 64,
    segments_around_tube: 32,
};

const COARSE_SEGMENTS: TorusSegments = TorusSegments {
    segments_around_axis: 8,
    segments_around_tube: 6,
};

/// Draws a scene with a margin of up to a hundred times its size. Most scenes begin within the margin.
fn scene_within_margin(rng: &mut Pcg64, most: usize) -> Scene {
    let mut scene = scene(rng, SceneKind::RandomMotion, most);
    let size = scene.bodies.each_ref().map(|body| body.tree().radius());
    let size = f64::from(size[0]) + f64::from(size[1]);
    let gap = distance(&scene.problem(), 0.0);
    scene.settings.margin = if rng.random_bool(0.5) {
        gap * rng.random_range(1.0..1.5)
    } else {
        lesser(size * random_power_of_ten(rng, -3.0, 2.0), 1e11)
    };
    scene
}

#[test]
fn a_start_within_any_margin_costs_one_distance() {
    let mut visits = Vec::new();
    for margin in [0.41, 1.0, 2.0, 5.0, 100.0] {
        let config = Settings {
            margin,
            ..Settings::DEFAULT
        };
        let answer = with_two_tori(FINE_SEGMENTS, 3.0, &config, solve);
        let Outcome::Touching { contact } = answer.outcome else {
            panic!("{margin}: {answer:?}");
        };
        let separation = contact.separation;
        assert!(separation.lower <= 0.4 && separation.upper >= 0.4);
        assert!(separation.upper - separation.lower < 2.0 * SKIPPED_PAIR_ALLOWANCE);
        visits.push(answer.stats.budgeted_work());
    }
    assert!(visits.iter().all(|&visits| visits < 1_000), "{visits:?}");
}

#[test]
fn a_budget_that_ends_at_the_start_is_unresolved() {
    for budget in [0, 1, 10, 20, 50, 100] {
        let config = Settings {
            margin: 5.0,
            budget,
            ..Settings::DEFAULT
        };
        let answer = with_two_tori(FINE_SEGMENTS, 1.5, &config, solve);
        assert!(
            match answer.outcome {
                Outcome::Overlapping { .. } => true,
                Outcome::Unresolved(Unresolved {
                    safe_until,
                    limit: reason,
                    ..
                }) => {
                    safe_until == 0.0 && reason == Limit::Budget
                }
                _ => false,
            },
            "{answer:?}"
        );
    }
}

#[test]
fn bounds_hold_the_distance_and_no_budget_makes_another_answer() {
    let mut rng = rng(31);
    let (mut touching, mut ended) = (0, 0);
    for number in 0..400 {
        let mut scene = scene_within_margin(&mut rng, 12);
        let problem = scene.problem();
        let full = solve(&problem);
        let Outcome::Touching { contact } = full.outcome else {
            continue;
        };
        touching += 1;
        let (separation, found) = (contact.separation, distance(&problem, 0.0));
        assert!(
            separation.lower <= found + problem.rounding
                && separation.upper >= found - problem.rounding
                && separation.upper <= problem.contact_distance(),
            "{number}: {found:e} {separation:?}"
        );
        let loose = separation.upper - separation.lower;
        let slack = 2.0 * SKIPPED_PAIR_ALLOWANCE * separation.upper + 8.0 * problem.rounding;
        assert!(loose <= slack, "{number}: {separation:?}");
        let visits = full.stats.iterations;
        for budget in 0..visits.min(80) {
            scene.settings.budget = budget;
            let outcome = solve(&scene.problem()).outcome;
            let ending = Outcome::unresolved(0.0, Limit::Budget);
            assert_eq!(outcome, ending, "{number}: {budget} of {visits}");
            ended += 1;
        }
        scene.settings.budget = full.stats.budgeted_work();
        assert_eq!(solve(&scene.problem()).outcome, full.outcome, "{number}");
    }
    assert!(touching > 100 && ended > 1_000, "{touching} {ended}");
}

#[test]
fn all_schedules_say_the_same_of_a_start() {
    let mut rng = rng(32);
    let mut touching = 0;
    for number in 0..400 {
        let scene = scene_within_margin(&mut rng, 8);
        let answers: Vec<Outcome> = schedules()
            .into_iter()
            .map(|mut schedule| {
                schedule
                    .answer_first_contact(&scene.problem(), &mut ExhaustiveOracle)
                    .outcome
            })
            .collect();
        if answers
            .iter()
            .any(|o| matches!(o, Outcome::Touching { .. }))
        {
            touching += 1;
            assert!(
                answers.iter().all(|o| *o == answers[0]),
                "{number}: {answers:?}"
            );
        }
    }
    assert!(touching > 100, "{touching}");
}

#[test]
fn a_deadline_ends_every_schedule_at_a_time_that_is_safe() {
    for policy in [StartPolicy::Report, StartPolicy::Leave] {
        let config = Settings {
            margin: 5.0,
            start_policy: policy,
            deadline: Some(Duration::ZERO),
            ..Settings::DEFAULT
        };
        for mut schedule in schedules() {
            let answer = with_two_tori(COARSE_SEGMENTS, 3.0, &config, |problem| {
                schedule.answer_first_contact(problem, &mut ExhaustiveOracle)
            });
            let Outcome::Unresolved(Unresolved {
                safe_until,
                limit: reason,
                ..
            }) = answer.outcome
            else {
                panic!("{answer:?}");
            };
            assert_eq!((safe_until, reason), (0.0, Limit::Deadline));
        }
    }
    // A deadline that is long enough changes nothing.
    let mut rng = rng(33);
    for _ in 0..50 {
        let mut scene = scene_within_margin(&mut rng, 8);
        let free = solve(&scene.problem());
        scene.settings.deadline = Some(Duration::from_secs(3600));
        assert_eq!(solve(&scene.problem()), free);
    }
}

/// Tests that the distance bounds of touching bodies hold even if the oracle makes false claims or gives up.
#[test]
fn false_claims_and_give_ups_never_make_wrong_bounds() {
    let mut rng = rng(34);
    let mut touching = 0;
    for _ in 0..300 {
        let mut scene = scene_within_margin(&mut rng, 6);
        scene.settings.budget = 5_000;
        let problem = scene.problem();
        let found = distance(&problem, 0.0);
        let lie = Claim {
            axis: DVec3::new(0.6, -0.8, 0.0),
            a: ConvexCombination::from_single_point(rng.random_range(0..3)),
            b: ConvexCombination::from_single_point(rng.random_range(0..3)),
        };
        for oracle in [
            ConstantOracle(Ok(lie)),
            ConstantOracle(Err(GiveUpReason::Cycle)),
        ] {
            let answer = BestFirst::default().answer_first_contact(&problem, &mut { oracle });
            if let Outcome::Touching { contact } = answer.outcome {
                touching += 1;
                let separation = contact.separation;
                assert!(separation.lower <= found + problem.rounding, "{answer:?}");
                assert!(separation.upper >= found - problem.rounding, "{answer:?}");
                assert!(separation.upper <= problem.contact_distance(), "{answer:?}");
            }
        }
    }
    assert!(touching > 50, "{touching}");
}

/// Tests that two bodies of one piece each are measured only once.
#[test]
fn single_pieces_are_measured_once() {
    let ball = Body::sphere(1.0).unwrap();
    let moving = |x: f64| MovingBody::from((&ball, Motion::still(Pose::at(x * DVec3::X).unwrap())));
    let config = Settings {
        margin: 10.0,
        ..Settings::DEFAULT
    };
    let answer = solve(&Problem::of_moving_bodies(moving(4.0), moving(0.0), 1.0, &config).unwrap());
    let Outcome::Touching { contact } = answer.outcome else {
        panic!("{answer:?}");
    };
    assert!(contact.separation.lower <= 2.0 && contact.separation.upper >= 2.0);
    assert_eq!(answer.stats.iterations, 2);
}
