//! Tests that answers with and without each shortcut agree, and that each shortcut saves work in its scene.

use crate::answer::{Answer, Outcome};
use crate::body::Body;
use crate::engine::answer::EngineSchedule;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::schedule::BestFirst;
use crate::settings::Settings;
use crate::settings::{Shortcut, Shortcuts};
use crate::tests::nearest::Triangle;
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{SceneKind, body, distance, rng, scene, sheet};
use glam::DVec3;
use std::f64::consts::TAU;

fn solve(problem: &Problem<'_>) -> Answer {
    BestFirst::default().answer_first_contact(problem, &mut ExhaustiveOracle)
}

/// Checks that two times of contact agree: at the earlier one, the bodies are as far apart as the answer with the later
/// one proves.
fn assert_apart_at_earlier_time(problem: &Problem<'_>, earlier: f64, number: usize) {
    let near = distance(problem, earlier);
    assert!(
        near >= problem.kept_gap() - problem.rounding,
        "{number}: {near:e}"
    );
}

#[test]
fn answers_without_a_shortcut_agree_with_those_of_all() {
    const SCENE_KINDS: [SceneKind; 4] = [
        SceneKind::RandomMotion,
        SceneKind::Sliding,
        SceneKind::NearRim,
        SceneKind::Receding,
    ];
    let mut rng = rng(7);
    let (mut contacts, mut free, mut changed) = (0, 0, 0);
    for number in 0..2_800 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 4], 12);
        scene.settings.budget = 20_000;
        let with = solve(&scene.problem());
        let mut problem = scene.problem();
        problem.shortcuts = Shortcuts::ALL.without(Shortcut::ALL[number / 4 % 7]);
        let without = solve(&problem);
        changed += u32::from(with.stats.budgeted_work() != without.stats.budgeted_work());
        match (with.outcome, without.outcome) {
            (Outcome::Contact { time: one, .. }, Outcome::Contact { time: other, .. }) => {
                contacts += 1;
                if one != other {
                    assert_apart_at_earlier_time(
                        &problem,
                        if one < other { one } else { other },
                        number,
                    );
                }
            }
            (Outcome::Free { .. }, Outcome::Free { .. }) => free += 1,
            (Outcome::Touching { .. }, Outcome::Touching { .. }) => {}
            (Outcome::Overlapping { .. }, Outcome::Overlapping { .. }) => {}
            (Outcome::Contact { time, .. }, Outcome::Free { .. })
            | (Outcome::Free { .. }, Outcome::Contact { time, .. }) => {
                assert_apart_at_earlier_time(&problem, time, number);
            }
            (Outcome::Unresolved(known), Outcome::Contact { time, .. })
            | (Outcome::Contact { time, .. }, Outcome::Unresolved(known)) => {
                assert!(known.safe_until <= time || distance(&problem, time) >= problem.kept_gap());
            }
            (Outcome::Unresolved(_), Outcome::Free { .. } | Outcome::Unresolved(_))
            | (Outcome::Free { .. }, Outcome::Unresolved(_)) => {}
            (with, without) => panic!("{number}: {with:?}, {without:?}"),
        }
    }
    assert!(contacts > 200 && free > 600, "{contacts} {free}");
    assert!(changed > 150, "{changed}");
}

/// Two bodies with their motions, and the tolerance of the query.
type Pair = ([Body; 2], [Motion; 2], f64);

fn pose_at(place: [f64; 3]) -> Pose {
    Pose::at(place).unwrap()
}

fn motion_from(place: [f64; 3], velocity: [f64; 3], spin: [f64; 3]) -> Motion {
    Motion::new(pose_at(place), velocity, spin).unwrap()
}

fn plate(half: f64, squares: usize) -> Body {
    let plate = sheet(squares, squares, |u, v| {
        [half * (2.0 * u - 1.0), half * (2.0 * v - 1.0), 0.0]
    });
    body(&plate)
}

fn tube(radius: f64, segments: usize) -> Body {
    let tube = sheet(4, segments, |u, v| {
        let (sin, cos) = (TAU * v).sin_cos();
        [radius * cos, radius * sin, u]
    });
    body(&tube)
}

/// Creates a disc of triangles that all share the center.
fn disc(segments: usize) -> Body {
    let rim = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / segments as f64).sin_cos();
        DVec3::new(cos, sin, 0.0)
    };
    let fan: Vec<Triangle> = (0..segments)
        .map(|k| [DVec3::ZERO, rim(k), rim(k + 1)])
        .collect();
    body(&fan)
}

/// Returns the scene that a shortcut is made for, which the README of the shortcuts describes.
fn scene_of(shortcut: Shortcut) -> Pair {
    let still = Motion::STILL;
    match shortcut {
        Shortcut::Balls => {
            let passing = motion_from([-5.0, 4.0, 0.0], [10.0, 0.0, 0.0], [0.0; 3]);
            ([plate(1.0, 4), tube(1.0, 16)], [passing, still], 1e-3)
        }
        Shortcut::Boxes => {
            let above = motion_from([-0.5, 0.0, 0.1], [1.0, 0.0, 0.0], [0.0; 3]);
            ([plate(1.0, 8), plate(1.0, 8)], [above, still], 1e-3)
        }
        Shortcut::Rounds => {
            let crank = |x: f64, y: f64| {
                let spin = [0.0, 0.0, 200.0 * TAU];
                Motion::about(pose_at([x, 0.0, 0.0]), [0.0; 3], spin, [y, 0.0, 0.0]).unwrap()
            };
            let ball = || Body::sphere(1.0).unwrap();
            (
                [ball(), ball()],
                [crank(3.0, -1.0), crank(-0.5, -1.0)],
                1e-3,
            )
        }
        Shortcut::Screw => {
            let turning = motion_from([0.0; 3], [0.0; 3], [0.0, 0.0, TAU]);
            ([tube(1.0, 64), tube(1.05, 64)], [turning, still], 1e-3)
        }
        Shortcut::FlatNodes => {
            let falling = motion_from([0.0, 0.0, 1e-3], [0.0, 0.0, -1.0], [0.0; 3]);
            ([plate(1.0, 16), plate(1.0, 16)], [falling, still], 1e-9)
        }
        Shortcut::TurningNodes => {
            let turning = motion_from([0.0; 3], [0.0; 3], [1.5, 0.0, 0.0]);
            let beside = motion_from([0.8, -0.02, 0.03], [0.0; 3], [0.0; 3]);
            ([disc(8), plate(0.01, 8)], [turning, beside], 1e-5)
        }
        Shortcut::TurningPieces => {
            let turning = motion_from([0.0; 3], [0.0; 3], [0.0, 0.0, 3.0]);
            let beside = motion_from([0.0, -1.0, 0.0], [0.0, 0.9, 0.0], [0.0; 3]);
            ([plate(0.5, 1), plate(0.01, 1)], [turning, beside], 1e-4)
        }
    }
}

/// Reads from the README the documented work in the scene of each shortcut: without any shortcut, and with this
/// shortcut alone.
fn documented_work() -> Vec<[u64; 2]> {
    let rows = include_str!("README.md")
        .lines()
        .filter(|line| line.starts_with("| `"));
    rows.map(|row| {
        let cells: Vec<&str> = row.trim_matches('|').split('|').collect();
        [3, 4].map(|at| cells[at].trim().replace(',', "").parse().unwrap())
    })
    .collect()
}

#[test]
fn each_shortcut_saves_the_work_that_is_documented() {
    let only = |kept: Option<Shortcut>| {
        let others = Shortcut::ALL.into_iter().filter(|&each| Some(each) != kept);
        others.fold(Shortcuts::ALL, Shortcuts::without)
    };
    let measured = Shortcut::ALL.map(|shortcut| {
        let ([a, b], [of_a, of_b], tolerance) = scene_of(shortcut);
        [None, Some(shortcut)].map(|kept| {
            let settings = Settings {
                tolerance,
                ..Settings::DEFAULT
            };
            let mut problem =
                Problem::of_moving_bodies((&a, of_a), (&b, of_b), 1.0, &settings).unwrap();
            problem.shortcuts = only(kept);
            solve(&problem).stats.budgeted_work()
        })
    });
    assert_eq!(measured.to_vec(), documented_work());
    for (shortcut, [without, with]) in Shortcut::ALL.iter().zip(measured) {
        assert!(2 * with < without, "{shortcut:?}: {with} of {without}");
    }
}
