//! Compares answers for bodies that turn many times with their exact distances each time they pass each other.

use super::*;
use crate::answer::Answer;
use crate::body::Body;
use crate::engine::answer::EngineSchedule;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::query::Query;
use crate::schedule::Schedule;
use crate::schedule::{BestFirst, DepthFirst, FirstContactSearch, Naive, Progress};
use crate::settings::Settings;
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{
    Pcg64, RngExt, SoupKind, body, distance, random_direction, random_point_in_ball,
    random_power_of_ten, random_rotation, random_triangle_soup, rng,
};
use glam::{DQuat, DVec3};
use std::f64::consts::TAU;

fn solve(problem: &Problem<'_>) -> Answer {
    BestFirst::default().answer_first_contact(problem, &mut ExhaustiveOracle)
}

/// Creates the motion of a ball of radius 1 on a circle of radius 5, which starts at a given angle.
fn orbiting_ball_motion(center: DVec3, velocity: DVec3, spin: f64, angle: f64) -> Motion {
    let at = center + 5.0 * DVec3::new(angle.cos(), angle.sin(), 0.0);
    let start = Pose::new(at, DQuat::from_rotation_z(angle)).unwrap();
    Motion::about(start, velocity, spin * DVec3::Z, -5.0 * DVec3::X).unwrap()
}

/// Returns the distance of two balls of radius 1 at a time.
fn gap([a, b]: [&Motion; 2], time: f64) -> f64 {
    let [a, b] = [a, b].map(|motion| motion.pose(time).translation());
    a.distance(b) - 2.0
}

/// Checks that the reported contact of two balls is their first contact, and returns its time.
fn checked_contact_time(motions: [&Motion; 2], duration: f64, config: &Settings) -> Option<f64> {
    let ball = Body::sphere(1.0).unwrap();
    let [a, b] = motions.map(|motion| (&ball, *motion));
    let problem = Problem::of_moving_bodies(a, b, duration, config).unwrap();
    let until = match solve(&problem).outcome {
        Outcome::Contact { time, contact } => {
            let near = gap(motions, time);
            let Separation { lower, upper, .. } = contact.separation;
            assert!(near <= config.tolerance + 1e-10, "{near} at {time}");
            assert!(
                lower <= near + 1e-10 && near <= upper + 1e-10,
                "{lower} {near} {upper}"
            );
            assert!(upper <= config.tolerance, "{upper}");
            Some(time)
        }
        Outcome::Free { proven_gap } => {
            assert!(proven_gap > 0.0);
            None
        }
        outcome => panic!("{outcome:?}"),
    };
    // A step is less than the tolerance, or a share of the distance.
    let mut time = 0.0;
    while time < until.unwrap_or(duration) {
        let gap = gap(motions, time);
        assert!(gap > 0.0, "they touch at {time} of {until:?}");
        time += greater(gap, config.tolerance) / 200.0;
    }
    until
}

/// Tests that a ball which drifts by a millionth in every turn is found to touch another ball late, in turn 500.
#[test]
fn a_slow_drift_ends_in_a_late_turn() {
    let config = Settings {
        tolerance: 1e-7,
        ..Settings::DEFAULT
    };
    let still = Motion::still(Pose::at(7.0005 * DVec3::X).unwrap());
    for (drift, turn) in [(1e-6, Some(500.0)), (2e-6, Some(250.0)), (0.0, None)] {
        let wheel = orbiting_ball_motion(DVec3::ZERO, drift * DVec3::X, TAU, 0.1);
        let found = checked_contact_time([&wheel, &still], 600.0, &config);
        assert_eq!(found.map(f64::round), turn);
    }
}

/// Tests that two balls with rotation rates of nearly one to two are found to touch late, after they miss each other by
/// less in every turn.
#[test]
fn rates_that_are_nearly_a_fraction_jam_late() {
    let config = Settings::DEFAULT;
    for (ratio, angle, turn) in [
        (2.0001, 1.538, Some(70.0)),
        (2.0001, 1.5, Some(9.0)),
        (2.0, 1.5, None),
        (1.9999, 1.5, None),
    ] {
        let a = orbiting_ball_motion(DVec3::ZERO, DVec3::ZERO, TAU, 0.0);
        let angle = angle + std::f64::consts::PI;
        let b = orbiting_ball_motion(8.0 * DVec3::X, DVec3::ZERO, -ratio * TAU, angle);
        let found = checked_contact_time([&a, &b], 100.0, &config);
        assert_eq!(found.map(f64::floor), turn, "{ratio} {angle}");
    }
}

/// Draws two random sets of triangles near each other, one or both of which turn many times.
fn scene(rng: &mut Pcg64, number: usize) -> ([Body; 2], [Motion; 2], Settings) {
    let count = rng.random_range(1..4);
    let bodies = [0; 2].map(|_| body(&random_triangle_soup(rng, SoupKind::WellShaped, count, 0.7)));
    let turns = random_power_of_ten(rng, 0.5, 2.0);
    let ratio = [0.0, 1.0, -0.5, 2.0 / 3.0, 0.61803, 0.5002][number % 6];
    let axis = random_direction(rng);
    let other = [axis, random_direction(rng)][rng.random_range(0..2)];
    let spins = [axis * turns * TAU, other * ratio * turns * TAU];
    // One soup passes the other on its path about the axis, at a distance from nothing to well apart.
    let (x, y) = axis.any_orthonormal_pair();
    let arm = rng.random_range(0.0..2.0);
    let apart = y * (arm + rng.random_range(0.3..1.3));
    let toward = [-y, random_direction(rng)][rng.random_range(0..2)];
    let drift = toward * [0.0, random_power_of_ten(rng, -4.0, 0.0)][rng.random_range(0..2)];
    let velocity = random_point_in_ball(rng, 1.0) * [0.0, 1.0][rng.random_range(0..2)];
    let motion = |rng: &mut Pcg64, center: DVec3, arm: DVec3, velocity: DVec3, spin: DVec3| {
        let turned = random_rotation(rng);
        let start = Pose::new(center + arm, turned).unwrap();
        Motion::about(start, velocity, spin, turned.inverse() * -arm).unwrap()
    };
    let motions = [
        motion(rng, DVec3::ZERO, arm * x, velocity, spins[0]),
        motion(rng, apart, DVec3::ZERO, velocity + drift, spins[1]),
    ];
    let config = Settings {
        tolerance: random_power_of_ten(rng, -4.0, -2.0),
        margin: [0.0, 0.05][rng.random_range(0..2)],
        ..Settings::DEFAULT
    };
    (bodies, motions, config)
}

#[test]
fn a_rotation_too_small_to_divide_does_not_hide_a_contact() {
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let [p, q, r, s] = [
        corner(-1.0, -1.0),
        corner(1.0, -1.0),
        corner(1.0, 1.0),
        corner(-1.0, 1.0),
    ];
    let square = body(&[[p, q, r], [p, r, s]]);
    let start = Pose::at(DVec3::new(2.3, 0.0, 0.5)).unwrap();
    let whirling = Motion::new(start, -DVec3::Z, 5e5 * DVec3::Z).unwrap();
    for spin in [0.0, 5e-324, 1e-320, 1e-300, 1e-101, 1e-99] {
        let other = Motion::new(Pose::IDENTITY, DVec3::ZERO, spin * DVec3::X).unwrap();
        for [a, b] in [[whirling, other], [other, whirling]] {
            let problem =
                Problem::of_moving_bodies((&square, a), (&square, b), 1.0, &Settings::DEFAULT);
            let outcome = solve(&problem.unwrap()).outcome;
            assert!(
                matches!(outcome, Outcome::Contact { time, .. } if (0.49..0.5).contains(&time)),
                "{spin}: {outcome:?}"
            );
        }
    }
}

#[test]
fn answers_of_many_turns_hold_at_sampled_times() {
    let mut rng = rng(3);
    let (mut hits, mut late, mut misses, mut repeated) = (0, 0, 0, 0);
    for number in 0..400 {
        let ([a, b], motions, config) = scene(&mut rng, number);
        let problem =
            Problem::of_moving_bodies((&a, motions[0]), (&b, motions[1]), 1.0, &config).unwrap();
        if distance(&problem, 0.0) < 2.0 * config.tolerance + config.margin {
            continue;
        }
        repeated += usize::from(PeriodicSearch::for_problem(&problem).is_some());
        let outcome = solve(&problem).outcome;
        let any = DepthFirst::default().any_contact_of(&problem, &mut ExhaustiveOracle);
        let within = config.margin + config.tolerance + 1e-9;
        if let Outcome::Contact { time, .. } = any.outcome {
            assert!(distance(&problem, time) <= within, "{number}: {time}");
        }
        let (until, least) = match outcome {
            Outcome::Contact { time, .. } => {
                hits += 1;
                late += usize::from(time > 0.5);
                assert!(distance(&problem, time) <= within, "{number}: {time}");
                (time, config.margin)
            }
            Outcome::Free { proven_gap } => {
                misses += 1;
                let least = config.margin + 0.5 * config.tolerance;
                assert!(proven_gap >= least - 1e-9, "{number}: {proven_gap}");
                (1.0, proven_gap)
            }
            outcome => panic!("{number}: {outcome:?}"),
        };
        let apart = matches!(any.outcome, Outcome::Free { .. });
        assert!(!apart || until == 1.0 || distance(&problem, until) > config.margin);
        for _ in 0..1_000 {
            let s = rng.random_range(0.0..1.0) * until;
            let found = distance(&problem, s);
            assert!(
                found >= least - 1e-9,
                "{number}: {found} < {least} at {s} of {until}"
            );
        }
    }
    let counts = format!("{hits} {late} {misses} {repeated}");
    assert!(
        hits > 60 && late > 5 && misses > 60 && repeated > 100,
        "{counts}"
    );
}

/// Tests that the naive schedule, which searches the whole duration at once, finds the same contacts.
#[test]
fn the_naive_schedule_agrees() {
    let mut rng = rng(4);
    let (mut hits, mut misses) = (0, 0);
    for number in 0..150 {
        let ([a, b], motions, config) = scene(&mut rng, number);
        let problem =
            Problem::of_moving_bodies((&a, motions[0]), (&b, motions[1]), 1.0, &config).unwrap();
        let twin = Naive::default()
            .answer_first_contact(&problem, &mut ExhaustiveOracle)
            .outcome;
        let near = |time: f64| distance(&problem, time) - config.margin;
        match (solve(&problem).outcome, twin) {
            (Outcome::Contact { time, .. }, Outcome::Contact { time: other, .. }) => {
                hits += 1;
                // Each time is that of a contact: neither search found one before the other's tolerance.
                let (first, last) = (lesser(time, other), greater(time, other));
                assert!(
                    near(first) <= config.tolerance + 1e-9 && near(last) <= config.tolerance + 1e-9
                );
            }
            (Outcome::Free { .. }, Outcome::Free { .. }) => misses += 1,
            (Outcome::Contact { time, .. }, Outcome::Free { .. })
            | (Outcome::Free { .. }, Outcome::Contact { time, .. }) => {
                assert!(near(time) > 0.0, "{number}");
            }
            (Outcome::Contact { .. } | Outcome::Free { .. }, Outcome::Unresolved(_)) => {}
            (outcome, other) => assert_eq!(
                std::mem::discriminant(&outcome),
                std::mem::discriminant(&other),
                "{number}: {outcome:?} {other:?}"
            ),
        }
    }
    assert!(hits > 20 && misses > 20, "{hits} {misses}");
}

/// Tests that a search in steps gives the answer of a whole search, for steps that end within a round or beyond it.
#[test]
fn steps_lead_to_the_same_answer() {
    let mut rng = rng(5);
    let mut steps = 0;
    for number in 0..300 {
        let ([a, b], motions, config) = scene(&mut rng, number);
        let query = Query::new((&a, motions[0]), (&b, motions[1]), 3.0, &config).unwrap();
        let whole = BestFirst::default()
            .first_contact(&query, &mut ExhaustiveOracle)
            .unwrap();
        let mut search = FirstContactSearch::new(query, BestFirst::default());
        let mut until = 0.0;
        let answer = loop {
            until += rng.random_range(0.0..1.0) * [1e-3, 0.5][rng.random_range(0..2)];
            match search.advance(&mut ExhaustiveOracle, until).unwrap() {
                Progress::ApartUntil(time) => {
                    assert!(time >= until, "{number}: {time} {until}");
                    steps += 1;
                    until = time;
                }
                Progress::Answered(answer) => break answer,
            }
        };
        assert_eq!(answer, whole, "{number}");
    }
    assert!(steps > 1_000, "{steps}");
}

/// Tests that the search over a thousand equal turns takes at most about twice the work of a search over four turns.
#[test]
fn a_thousand_turns_cost_what_one_does() {
    let mut rng = rng(6);
    let mut free = 0;
    for number in 0..60 {
        let ([a, b], [first, second], config) = scene(&mut rng, number);
        let turn = |motion: Motion, ratio: f64, turns: f64| {
            let spin = motion.angular_velocity().normalize_or_zero() * TAU * ratio * turns;
            Motion::about(motion.start(), DVec3::ZERO, spin, motion.center()).unwrap()
        };
        let ratio = [0.0, 0.5, 1.0][number % 3];
        let work = |turns: f64| {
            let [a, b] = [
                (&a, turn(first, 1.0, turns)),
                (&b, turn(second, ratio, turns)),
            ];
            let answer = solve(&Problem::of_moving_bodies(a, b, 1.0, &config).unwrap());
            matches!(answer.outcome, Outcome::Free { .. }).then_some(answer.stats.budgeted_work())
        };
        if let (Some(few), Some(many)) = (work(4.0), work(1_000.0)) {
            free += 1;
            assert!(many <= 2 * few + 8, "{number}: {few} {many}");
        }
    }
    assert!(free > 15, "{free}");
}

/// Tests that bounds of the least distance over a thousand turns hold at sampled times.
#[test]
fn closest_approaches_of_many_turns_hold_at_sampled_times() {
    let mut rng = rng(7);
    let mut sampled = 0;
    for number in 0..60 {
        let ([a, b], [first, second], config) = scene(&mut rng, number);
        let turn = |motion: Motion, turns: f64| {
            let spin = motion.angular_velocity().normalize_or_zero() * TAU * turns;
            Motion::about(motion.start(), first.velocity(), spin, motion.center()).unwrap()
        };
        let ratio = [0.0, 0.5, 1.0, 0.4][number % 4];
        let problem = |turns: f64| {
            let moving = (&a, turn(first, turns));
            Problem::of_moving_bodies(moving, (&b, turn(second, ratio * turns)), 1.0, &config)
                .unwrap()
        };
        let [few, many] = [20.0, 1_000.0].map(|turns| {
            let problem = problem(turns);
            DepthFirst::default().closest_approach_of(&problem, &mut ExhaustiveOracle)
        });
        let whole = problem(1_000.0);
        sampled += usize::from(RepresentativePeriod::for_problem(&whole.for_distances()).is_some());
        let (lower, upper) = (many.outcome.lower(), many.outcome.upper());
        if let Outcome::LeastDistance { time, .. } = many.outcome {
            assert!(upper - lower <= config.tolerance + 1e-12, "{number}");
            assert!(
                (distance(&whole, time) - upper).abs() <= config.tolerance,
                "{number}"
            );
            assert!(
                (few.outcome.upper() - upper).abs() <= config.tolerance,
                "{number}"
            );
            assert!(
                many.stats.budgeted_work() <= 2 * few.stats.budgeted_work() + 8,
                "{number}"
            );
        }
        for _ in 0..1_000 {
            let found = distance(&whole, rng.random_range(0.0..1.0));
            assert!(found >= lower - 1e-9, "{number}: {found} < {lower}");
        }
    }
    assert!(sampled > 40, "{sampled}");
}
