//! Tests the clocks of a single pair of pieces, and the time of its contact.

use super::*;
use crate::body::Body;
use crate::body::piece::ConvexCombination;
use crate::distance::oracle::{Claim, GiveUpReason};
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::query::MovingBody;
use crate::settings::{Settings, StartPolicy};
use crate::tests::oracle::{ConstantOracle, ExhaustiveOracle};
use glam::DVec3;

/// Calls `then` with the problem of two balls of radius 1: one at `x` that moves along −x at `speed`, one at rest at
/// the origin.
fn with_two_balls<R>(
    x: f64,
    speed: f64,
    config: &Settings,
    then: impl FnOnce(&Problem<'_>) -> R,
) -> R {
    let ball = Body::sphere(1.0).unwrap();
    let start = Pose::at(x * DVec3::X).unwrap();
    let a = MovingBody::from((
        &ball,
        Motion::new(start, -speed * DVec3::X, DVec3::ZERO).unwrap(),
    ));
    let b = MovingBody::from((&ball, Motion::still(Pose::IDENTITY)));
    then(&Problem::of_moving_bodies(a, b, 1.0, config).unwrap())
}

/// Advances a new pair until a step is not a clock before the end, and returns that step and the clock at which it was
/// made.
fn advance_to_last_step(problem: &Problem<'_>) -> (f64, PairStep) {
    let mut pair = Pair::new(0, 0);
    let mut s = 0.0;
    for _ in 0..128 {
        match pair.advance(problem, &mut ExhaustiveOracle, &mut Meter::new(problem), s) {
            PairStep::Free(free @ FreeTime::AtLeast(_)) => {
                let clock = free.clock_after(s);
                assert!(clock > s);
                s = clock;
            }
            step => return (s, step),
        }
    }
    panic!("no end after 128 steps, at {s}");
}

#[test]
fn two_balls_meet_when_they_do() {
    let config = Settings::DEFAULT;
    let (s, step) = with_two_balls(4.0, 4.0, &config, advance_to_last_step);
    assert!(matches!(step, PairStep::Contact(_)), "two balls meet");
    // The gap of 2 is closed at half the duration. The balls stop within the tolerance of it.
    assert!(s <= 0.5 && s > 0.5 - config.tolerance / 4.0, "{s}");
}

#[test]
fn a_pair_that_recedes_is_done_with() {
    let (s, step) = with_two_balls(4.0, -4.0, &Settings::DEFAULT, advance_to_last_step);
    assert_eq!(s, 0.0);
    assert!(matches!(step, PairStep::Free(FreeTime::ToEnd)));
}

#[test]
fn the_margin_is_kept() {
    let config = Settings {
        margin: 1.0,
        ..Settings::DEFAULT
    };
    let (s, step) = with_two_balls(4.0, 4.0, &config, advance_to_last_step);
    assert!(matches!(step, PairStep::Contact(_)));
    assert!(s <= 0.25 && s > 0.2497, "{s}");
}

#[test]
fn overlap_and_touching_are_distinguished() {
    let (s, step) = with_two_balls(1.9, 0.0, &Settings::DEFAULT, advance_to_last_step);
    assert!(s == 0.0 && matches!(step, PairStep::Overlap(_)));
    let (s, step) = with_two_balls(2.0, 0.0, &Settings::DEFAULT, advance_to_last_step);
    assert!(s == 0.0 && matches!(step, PairStep::Contact(_)));
}

#[test]
fn pairs_that_touch_at_the_start_are_let_go_unless_they_approach() {
    let config = Settings {
        start_policy: StartPolicy::Leave,
        ..Settings::DEFAULT
    };
    // Pairs that begin with a gap are handled by the search, which uses half of the gap.
    let x = 2.0;
    let (_, step) = with_two_balls(x, -1.0, &config, advance_to_last_step);
    assert!(matches!(step, PairStep::Free(_)), "parting");
    let (_, step) = with_two_balls(x, 0.0, &config, advance_to_last_step);
    assert!(matches!(step, PairStep::Free(_)), "resting");
    let (s, step) = with_two_balls(x, 1.0, &config, advance_to_last_step);
    assert!(matches!(step, PairStep::Contact(_)), "approaching");
    // The contact is never late, except for the rounding of resting.
    assert!(s <= 1e-12, "{s}");
    // A second touch after parting is a contact at the query's own tolerance.
    let (s, step) = with_returning_bar(&config, advance_to_last_step);
    assert!(matches!(step, PairStep::Contact(_)));
    let exact = 1.0 - 2.0 * 0.2f64.atan2(0.9) / std::f64::consts::PI;
    assert!(s > exact - 1e-3 && s <= exact + 1e-12, "{s}");
}

/// Calls `then` with the problem of a bar that turns about y away from a ball it touches. The other end of the bar then
/// comes around to the ball.
fn with_returning_bar<R>(config: &Settings, then: impl FnOnce(&Problem<'_>) -> R) -> R {
    let bar = Body::capsule(0.1, 1.0).unwrap();
    let ball = Body::sphere(0.1).unwrap();
    let turn = std::f64::consts::TAU;
    // The other end of the bar comes around.
    let turns = Motion::new(Pose::IDENTITY, DVec3::ZERO, 0.5 * turn * DVec3::Y).unwrap();
    let a = MovingBody::from((&bar, turns));
    let beside = Pose::at(DVec3::new(-0.2, 0.0, 0.9)).unwrap();
    let b = MovingBody::from((&ball, Motion::still(beside)));
    then(&Problem::of_moving_bodies(a, b, 1.0, config).unwrap())
}

#[test]
fn an_oracle_that_gives_up_is_counted() {
    let (step, stats) = with_two_balls(4.0, 4.0, &Settings::DEFAULT, |problem| {
        let mut oracle = ConstantOracle(Err(GiveUpReason::StepCap));
        let mut meter = Meter::new(problem);
        let step = Pair::new(0, 0).advance(problem, &mut oracle, &mut meter, 0.0);
        (step, meter.stats)
    });
    assert!(matches!(step, PairStep::GaveUp));
    assert_eq!((stats.oracle_calls, stats.give_ups), (1, 1));
}

#[test]
fn a_dishonest_oracle_cannot_make_a_pair_late() {
    let directions = [
        DVec3::X,
        -DVec3::X,
        DVec3::Y,
        DVec3::ZERO,
        DVec3::NAN,
        DVec3::INFINITY,
    ];
    for axis in directions {
        let claim = Claim {
            axis,
            a: ConvexCombination::from_single_point(7),
            b: ConvexCombination::EMPTY,
        };
        let step = with_two_balls(4.0, 4.0, &Settings::DEFAULT, |problem| {
            Pair::new(0, 0).advance(
                problem,
                &mut ConstantOracle(Ok(claim)),
                &mut Meter::new(problem),
                0.0,
            )
        });
        // A pair of points has only one axis, which the check finds for any claim.
        match step {
            PairStep::Free(free) => {
                let clock = free.clock_after(0.0);
                assert!(clock <= 0.5, "{axis}: {clock}");
            }
            PairStep::Stalled => {}
            _ => panic!("neither contact nor overlap"),
        }
    }
}
