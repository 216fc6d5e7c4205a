//! Tests that a search in steps of any length gives the answer of the best-first schedule.

use super::*;
use crate::answer::Outcome;
use crate::body::pieces::Pieces;
use crate::body::{Body, Solidity};
use crate::engine::answer::EngineSchedule;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::settings::{Settings, StartPolicy};
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{Pcg64, RngExt, Scene, SceneKind, distance, rng, scene};
use glam::DVec3;

/// Answers a query in steps of random lengths, and counts the steps.
fn answer_in_steps(
    problem: &Problem<'_>,
    memory: &mut BestFirst<ExhaustiveOracle>,
    rng: &mut Pcg64,
) -> (Answer, u32) {
    let mut search = BestFirstSearch::new(Cow::Borrowed(problem), std::mem::take(memory));
    let (mut until, mut steps) = (0.0, 0);
    let answer = loop {
        match search.advance(&mut ExhaustiveOracle, until) {
            Progress::ApartUntil(time) => {
                assert!(time >= until, "{time:e} {until:e}");
                // The step is often the least possible one.
                until = match rng.random_range(0..3) {
                    0 => time.next_up(),
                    _ => time + rng.random_range(0.0..0.3),
                };
                steps += 1;
            }
            Progress::Answered(answer) => break answer,
        }
    };
    assert_eq!(
        search.advance(&mut ExhaustiveOracle, 0.0),
        Progress::Answered(answer)
    );
    *memory = search.into_schedule();
    (answer, steps)
}

#[test]
fn steps_do_not_change_the_answer() {
    let mut rng = rng(1);
    let mut memory = BestFirst::default();
    let (mut hits, mut misses, mut starts, mut limits, mut steps) = (0, 0, 0, 0, 0);
    for number in 0..3_000 {
        let kind = [
            SceneKind::RandomMotion,
            SceneKind::Sliding,
            SceneKind::NearRim,
            SceneKind::Receding,
        ][rng.random_range(0..4)];
        let mut scene: Scene = scene(&mut rng, kind, 12);
        if rng.random_range(0..3) == 0 {
            // The bodies are in contact at the start, unless they overlap.
            scene.settings.tolerance = 2.0 * distance(&scene.problem(), 0.0) + 1e-9;
        }
        scene.settings.start_policy =
            [StartPolicy::Report, StartPolicy::Leave][rng.random_range(0..2)];
        if rng.random_range(0..4) == 0 {
            scene.settings.budget = rng.random_range(0..60);
        }
        let problem = scene.problem();
        let whole = BestFirst::default().answer_first_contact(&problem, &mut ExhaustiveOracle);
        let (answer, taken) = answer_in_steps(&problem, &mut memory, &mut rng);
        assert_eq!(answer, whole, "{number}");
        steps += taken;
        match answer.outcome {
            Outcome::Contact { .. } => hits += 1,
            Outcome::Free { .. } => misses += 1,
            Outcome::Touching { .. } | Outcome::Overlapping { .. } => starts += 1,
            Outcome::Unresolved(_) => limits += 1,
            other => panic!("no outcome of a first contact: {other:?}"),
        }
    }
    assert!(
        hits > 200 && misses > 200 && starts > 50 && limits > 100,
        "{hits} {misses} {starts} {limits}"
    );
    assert!(steps > 4_000, "{steps}");
}

#[test]
fn a_search_goes_no_further_than_it_is_asked() {
    let mut rng = rng(2);
    let (mut less, mut all) = (0, 0);
    for _ in 0..300 {
        let scene = scene(&mut rng, SceneKind::Sliding, 12);
        let problem = scene.problem();
        let mut search = BestFirstSearch::new(Cow::Borrowed(&problem), BestFirst::default());
        search.advance(&mut ExhaustiveOracle, 0.05);
        less += search.meter.stats.iterations;
        search.advance(&mut ExhaustiveOracle, 1.0);
        all += search.meter.stats.iterations;
    }
    assert!(less > 0 && 2 * less < all, "{less} of {all}");
}

/// Tests that the time that a step reaches is not before the requested time, for durations down to the least positive
/// number.
#[test]
fn a_time_that_is_reached_is_not_before_the_one_asked_for() {
    let mut rng = rng(3);
    let mut reached = 0;
    for duration in [5e-324, 6e-323, 1e-320, 1e-290, 1e-9, 0.3, 7.0, 1e200] {
        for _ in 0..100 {
            let scene = scene(&mut rng, SceneKind::Sliding, 12);
            let slowed = |k: usize| {
                let motion = scene.motions[k];
                let velocity = motion.velocity() / duration;
                let velocity = velocity.clamp(DVec3::splat(-1e300), DVec3::splat(1e300));
                let slow = Motion::about(motion.start(), velocity, DVec3::ZERO, motion.center());
                (&scene.bodies[k], slow.unwrap())
            };
            let problem =
                Problem::of_moving_bodies(slowed(0), slowed(1), duration, &scene.settings).unwrap();
            let mut search = BestFirstSearch::new(Cow::Borrowed(&problem), BestFirst::default());
            for exponent in [-320, -17, -9, -3, -1, -1, -1] {
                let until = duration * rng.random_range(0.5..1.5) * 10f64.powi(exponent);
                if let Progress::ApartUntil(time) = search.advance(&mut ExhaustiveOracle, until) {
                    assert!(time >= until, "{time:e} {until:e} {duration:e}");
                    reached += 1;
                }
            }
        }
    }
    assert!(reached > 500, "{reached}");
}

/// Tests that a step of any length reports a ball inside a solid cube as overlapping, although no pair of pieces meets.
#[test]
fn a_body_inside_the_other_is_no_body_apart() {
    let room = solid_cube(4.0);
    let ball = Body::sphere(0.5).unwrap();
    let flies = Motion::new(Pose::IDENTITY, DVec3::X, DVec3::ZERO).unwrap();
    for motion in [Motion::STILL, flies] {
        let [a, b] = [(&ball, motion), (&room, Motion::STILL)];
        let problem = Problem::of_moving_bodies(a, b, 1.0, &Settings::DEFAULT).unwrap();
        for until in [0.0, 1e-9, 0.1, 2.0] {
            let mut search = BestFirstSearch::new(Cow::Borrowed(&problem), BestFirst::default());
            let progress = search.advance(&mut ExhaustiveOracle, until);
            assert!(
                matches!(
                    progress,
                    Progress::Answered(Answer {
                        outcome: Outcome::Overlapping { .. },
                        ..
                    })
                ),
                "{until}: {progress:?}"
            );
        }
    }
}

/// Creates a solid cube of twelve triangles.
fn solid_cube(half: f64) -> Body {
    let corner = |k: u32| {
        let sign = |bit: u32| if k >> bit & 1 == 1 { half } else { -half };
        DVec3::new(sign(0), sign(1), sign(2))
    };
    let corners: Vec<DVec3> = (0..8).map(corner).collect();
    let faces = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    let ids: Vec<u32> = (0..12).collect();
    Body::new(
        &Pieces::from_triangles(&corners, &faces, &ids).unwrap(),
        Solidity::Solid,
    )
    .unwrap()
}
