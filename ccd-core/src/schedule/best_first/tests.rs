//! Whole queries: against sampled truth, the naive twin, tiny budgets, and a million pairs at once.

use super::*;
use crate::body::Body;
use crate::motion::Motion;
use crate::oracle::{Claim, Combination, GiveUp};
use crate::pose::Pose;
use crate::problem::{Config, Moving, StartPolicy};
use crate::schedule::Naive;
use crate::tests::nearest::{Triangle, nearest};
use crate::tests::oracle::{Always, Exhaustive};
use crate::tests::scene::{Kind, RngExt, Scene, body, direction, rng, scene, within};
use glam::DVec3;

fn solve(problem: &Problem<'_>) -> Answer {
    BestFirst::default().solve(problem, &mut Exhaustive)
}

/// The least distance of any two triangles at a clock.
fn distance(problem: &Problem<'_>, s: f64) -> f64 {
    let [a, b] = [&problem.a, &problem.b].map(|side| {
        let frame = side.path.frame(s);
        let pieces = side.body.pieces();
        let placed = |k: usize| pieces.triangle(k).map(|p| frame.point(p));
        (0..pieces.len()).map(placed).collect::<Vec<Triangle>>()
    });
    let pairs = a.iter().flat_map(|x| b.iter().map(move |y| nearest(x, y).distance));
    pairs.fold(f64::INFINITY, f64::min)
}

/// A scene that does not begin in contact.
fn apart(rng: &mut crate::tests::scene::Pcg64) -> Scene {
    loop {
        let kind = [Kind::Any, Kind::Sliding, Kind::Rim][rng.random_range(0..3)];
        let scene = scene(rng, kind, 12);
        let problem = scene.problem();
        if distance(&problem, 0.0) > 2.0 * problem.tolerance() {
            return scene;
        }
    }
}

#[test]
fn answers_hold_at_sampled_times_and_are_those_of_the_naive_twin() {
    let mut rng = rng(1);
    let (mut hits, mut misses) = (0, 0);
    for number in 0..1_500 {
        let scene = apart(&mut rng);
        let problem = scene.problem();
        let (margin, tolerance) = (problem.margin, problem.tolerance());
        let answer = solve(&problem);
        let twin = Naive::default().solve(&problem, &mut Exhaustive);
        let (until, least) = match (answer.outcome, twin.outcome) {
            (Outcome::Contact { time, contact }, Outcome::Contact { time: other, .. }) => {
                hits += 1;
                let near = distance(&problem, time);
                assert!(near <= margin + tolerance + problem.rounding, "{number}: {near:e}");
                assert!(contact.separation.lower <= near + problem.rounding);
                // Both stop within the tolerance of one contact: neither long before the other.
                let (first, last) = (time.min(other), time.max(other));
                assert!(distance(&problem, first) <= margin + tolerance + problem.rounding);
                assert!(distance(&problem, last) <= margin + tolerance + problem.rounding);
                (time, margin)
            }
            (Outcome::Free { clearance }, Outcome::Free { .. }) => {
                misses += 1;
                (1.0, clearance)
            }
            (outcome, other) => panic!("{number}: {outcome:?}, {other:?}"),
        };
        for k in 0..64 {
            let found = distance(&problem, until * f64::from(k) / 64.0);
            assert!(found >= least - problem.rounding, "{number}: {found:e} before {until}");
        }
    }
    assert!(hits > 200 && misses > 200, "{hits} {misses}");
}

#[test]
fn budgets_end_a_query_with_a_time_that_is_safe_and_grows() {
    let mut rng = rng(2);
    let mut ended = 0;
    for number in 0..150 {
        let mut scene = apart(&mut rng);
        let (contact, visits) = {
            let answer = solve(&scene.problem());
            let time = match answer.outcome {
                Outcome::Contact { time, .. } => time,
                _ => 1.0,
            };
            (time, answer.stats.node_visits)
        };
        let mut last = 0.0;
        for budget in 0..visits.min(60) {
            scene.config.budget = budget;
            let answer = solve(&scene.problem());
            let Outcome::Unresolved { safe_until, reason } = answer.outcome else {
                panic!("{number}: {:?} for {budget} of {visits}", answer.outcome);
            };
            assert_eq!(reason, Limit::Budget);
            assert!(safe_until >= last && safe_until <= contact, "{number}: {safe_until}");
            last = safe_until;
            ended += 1;
        }
        scene.config.budget = visits;
        assert!(!matches!(solve(&scene.problem()).outcome, Outcome::Unresolved { .. }));
    }
    assert!(ended > 1_000, "{ended}");
}

#[test]
fn the_same_query_gives_the_same_bits_whatever_came_before() {
    let mut rng = rng(3);
    let mut kept = BestFirst::default();
    for _ in 0..200 {
        let scene = apart(&mut rng);
        let problem = scene.problem();
        let fresh = solve(&problem);
        assert_eq!(kept.solve(&problem, &mut Exhaustive), fresh);
        assert_eq!(kept.solve(&problem, &mut Exhaustive), fresh);
    }
}

#[test]
fn an_oracle_that_gives_up_or_lies_never_makes_an_answer_late() {
    let mut rng = rng(4);
    let (mut unresolved, mut others) = (0, 0);
    for _ in 0..300 {
        let mut scene = apart(&mut rng);
        scene.config.budget = 20_000;
        let problem = scene.problem();
        let truth = match solve(&problem).outcome {
            Outcome::Contact { time, .. } => time,
            _ => 1.0,
        };
        // A contact may be told within the tolerance of when it is: never after.
        let touch = (0..=64)
            .map(|k| truth + (1.0 - truth) * f64::from(k) / 64.0)
            .find(|&s| distance(&problem, s) <= problem.margin);
        let lie = Claim {
            axis: direction(&mut rng),
            a: Combination::point(rng.random_range(0..5)),
            b: Combination::point(rng.random_range(0..5)),
        };
        for oracle in [Always(Ok(lie)), Always(Err(GiveUp::Cycle))] {
            let answer = BestFirst::default().solve(&problem, &mut { oracle });
            match answer.outcome {
                Outcome::Unresolved { safe_until, .. } => {
                    unresolved += 1;
                    assert!(touch.is_none_or(|touch| safe_until <= touch));
                }
                Outcome::Contact { time, .. } => {
                    others += 1;
                    assert!(touch.is_none_or(|touch| time <= touch));
                }
                Outcome::Free { .. } => {
                    others += 1;
                    assert!(touch.is_none());
                }
                outcome => panic!("{outcome:?} of bodies that begin apart"),
            }
        }
    }
    assert!(unresolved > 50 && others > 50, "{unresolved} {others}");
}

#[test]
fn touching_and_overlapping_at_the_start_are_told_and_let_go() {
    let flat = body(&[[DVec3::ZERO, DVec3::X, DVec3::Y]]);
    let spike = body(&[[DVec3::ZERO, DVec3::new(-0.1, 0.0, 1.0), DVec3::new(0.1, 0.0, 1.0)]]);
    let outcome = |height: f64, speed: f64, start: StartPolicy| {
        let at = Pose::from_translation(DVec3::new(0.3, 0.3, height)).unwrap();
        let moving = |body, motion| Moving { body, motion };
        let config = Config {
            start,
            ..Config::default()
        };
        let motion = Motion::new(at, speed * DVec3::Z, DVec3::ZERO).unwrap();
        let still = Motion::still(Pose::IDENTITY);
        let problem = Problem::new(moving(&spike, motion), moving(&flat, still), 1.0, &config);
        solve(&problem.unwrap()).outcome
    };
    for height in [0.0, 1e-4] {
        let report = outcome(height, 1.0, StartPolicy::Report);
        assert!(matches!(report, Outcome::Touching { .. }), "{report:?}");
        let parting = outcome(height, 1.0, StartPolicy::Leave);
        assert!(matches!(parting, Outcome::Free { .. }), "{parting:?}");
        let approaching = outcome(height, -1.0, StartPolicy::Leave);
        let Outcome::Contact { time, .. } = approaching else {
            panic!("{approaching:?}");
        };
        assert!(time <= height + 1e-12);
    }
    for start in [StartPolicy::Report, StartPolicy::Leave] {
        let inside = outcome(-0.5, 1.0, start);
        let Outcome::Overlapping { overlap: crate::Overlap::Pieces(contact) } = inside else {
            panic!("{inside:?}");
        };
        assert!(contact.separation.lower < 0.0);
    }
}

/// Sticks through the unit ball, as triangles without area.
fn sticks(rng: &mut crate::tests::scene::Pcg64, count: usize) -> Vec<Triangle> {
    (0..count)
        .map(|_| {
            let (middle, way) = (within(rng, 0.5), direction(rng));
            [middle - way, middle + way, middle + way]
        })
        .collect()
}

/// A lower bound of the distance of two sticks: that of their lines.
fn lines_apart(a: &Triangle, b: &Triangle) -> f64 {
    let across = (a[1] - a[0]).cross(b[1] - b[0]);
    across.dot(b[0] - a[0]).abs() / across.length()
}

/// Every stick of one body is near every one of the other: all nine million pairs have to be told
/// apart at the start, and wait for their clocks.
#[test]
fn a_million_groups_of_pairs_wait_at_once() {
    const COUNT: usize = 3_200;
    let mut rng = rng(5);
    let soups = [(); 2].map(|()| sticks(&mut rng, COUNT));
    let bodies: [Body; 2] = [body(&soups[0]), body(&soups[1])];
    let velocity = 1e-3 * direction(&mut rng);
    let problem = |budget: u64, config: &mut Config| -> Answer {
        *config = Config {
            tolerance: 1e-9,
            budget,
            ..Config::default()
        };
        let moving = |k: usize, motion| Moving {
            body: &bodies[k],
            motion,
        };
        let start = Motion::new(Pose::IDENTITY, velocity, DVec3::ZERO).unwrap();
        let still = Motion::still(Pose::IDENTITY);
        solve(&Problem::new(moving(0, start), moving(1, still), 1.0, config).unwrap())
    };
    let mut config = Config::default();
    let answer = problem(1 << 24, &mut config);
    assert!(answer.stats.peak_front > 1 << 20, "{:?}", answer.stats);
    let Outcome::Contact { time, contact } = answer.outcome else {
        panic!("{answer:?}");
    };
    assert!(contact.separation.upper <= answer.tolerance);
    assert!(time > 0.0);
    // Of nine million pairs only those whose lines are near enough can meet before that time.
    let speed = velocity.length();
    let mut candidates = 0;
    for a in &soups[0] {
        for b in &soups[1] {
            if lines_apart(a, b) > speed * time + answer.tolerance {
                continue;
            }
            candidates += 1;
            for k in 0..=32 {
                // Up to shortly before the time told, when the pair found is about to touch.
                let shift = velocity * time * (f64::from(k) / 32.0);
                let found = nearest(&a.map(|p| p + shift), b).distance;
                assert!(found > 1e-3 * answer.tolerance, "{found:e} apart, step {k} of 32");
            }
        }
    }
    assert!(candidates > 0);
    // Not enough visits for all: what is certified until then is no later.
    let Outcome::Unresolved { safe_until, reason } = problem(1_000_000, &mut config).outcome else {
        panic!("a million visits are not enough");
    };
    assert_eq!(reason, Limit::Budget);
    assert!(safe_until <= time);
}
