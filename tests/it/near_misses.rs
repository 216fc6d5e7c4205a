//! Tests that near misses cost little more than wide misses.

use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::schedule::{BestFirst, Schedule};
use ccd_core::{Body, Motion, Outcome, Pose, Settings};
use ccd_distance_gjk::Gjk;
use rigid_ccd::Solver;
use rigid_ccd::trajectory::{Ballistic, Chain, Curve, Joint, OrientationCurve, Spline, Trajectory};
use std::f64::consts::PI;

/// Tests that a rod that rotates past a wall at a small distance, T6, takes at most two steps. When a corner is
/// nearest, the whole gap is left to advance by. What the other corners do then must not matter.
#[test]
fn a_rod_that_turns_past_a_wall_takes_few_steps() {
    let (thin, long) = (0.05, 2.0f64);
    let rod = Body::cuboid([thin, 0.3, long]).unwrap();
    let wall = Body::cuboid([1.0, 3.0, 3.0]).unwrap();
    let turning = Motion::new(Pose::IDENTITY, DVec3::ZERO, PI * DVec3::Y).unwrap();
    for exponent in 1..=10 {
        let gap = 10f64.powi(-exponent);
        let away = Pose::at((long.hypot(thin) + gap + 1.0) * DVec3::X).unwrap();
        let config = Settings {
            tolerance: 0.25 * gap,
            ..Settings::DEFAULT
        };
        let problem =
            ccd_core::Query::new((&rod, turning), (&wall, Motion::still(away)), 1.0, &config);
        let answer = BestFirst::default()
            .first_contact(&problem.unwrap(), &mut Gjk)
            .unwrap();
        assert!(matches!(answer.outcome, Outcome::Free { .. }), "{answer:?}");
        assert!(answer.stats.iterations <= 2, "{gap}: {:?}", answer.stats);
    }
}

/// Tests that a ball passes a box in few steps at any gap: on a straight line, on curves, and in the hand of an arm. A
/// straight path and a parabola take as many steps at any gap. Other curves are cut into segments with an allowed
/// deviation. Near the face these are short, and each is a multiple of the one before.
#[test]
fn a_ball_past_a_box_takes_few_steps() {
    let at = |z: f64| Pose::at([0.0, 0.0, z]).unwrap();
    let aside = Pose::at([-3.0, 0.0, 0.0]).unwrap();
    let flies = Motion::new(aside, [6.0, 0.0, 0.0], [0.0; 3]).unwrap();
    let straight = Ballistic::new(flies, [0.0; 3]).unwrap();
    let curve = |heights: [f64; 4]| {
        let points: [[f64; 3]; 4] =
            std::array::from_fn(|k| [2.0 * k as f64 - 3.0, 0.0, heights[k]]);
        Spline::new(Curve::bezier(&points, 1.0).unwrap(), OrientationCurve::NONE)
    };
    let (parabola, cubic) = (curve([2.0, -1.0, -1.0, 2.0]), curve([2.0, -2.0, 1.0, 2.0]));
    let joint = |z: f64| Joint::revolute(at(z), [0.0, 1.0, 0.0]).unwrap();
    // The curve is stretched downwards at half the time.
    let joints = vec![joint(0.0), joint(-1.0), Joint::fixed(at(-1.0))];
    let chain = Chain::new(Pose::IDENTITY, joints);
    let hand = (chain.link(3, &[-1.0, -1.0, 0.0], &[1.0, 1.0, 0.0], 1.0)).unwrap();
    for gap in [1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 0.0] {
        // If little more than rounding is left, no trajectory is exact.
        let few = if gap > 1e-10 { 4 } else { 20 };
        for (way, most) in [(&straight as &dyn Trajectory, few), (&parabola, few)] {
            assert!(max_iteration_count(way, gap) <= most, "{gap}");
        }
        for (way, most) in [(&cubic as &dyn Trajectory, 120), (&hand, 75)] {
            assert!(max_iteration_count(way, gap) <= most, "{gap}");
        }
    }
}

/// Answers three questions about a ball that passes a box at a gap, or touches it if the gap is 0. Returns the largest
/// number of visited pairs.
fn max_iteration_count(trajectory: &dyn Trajectory, gap: f64) -> u64 {
    let radius = 0.25;
    let (ball, cube) = (
        Body::sphere(radius).unwrap(),
        Body::cuboid([1.0; 3]).unwrap(),
    );
    let a = (&ball, trajectory);
    let below =
        Motion::still(Pose::at([0.0, 0.0, least_height(trajectory) - radius - gap - 1.0]).unwrap());
    let b = (&cube, &below);
    let tolerance = if gap > 0.0 { 0.25 * gap } else { 1e-9 };
    let config = Settings {
        tolerance,
        ..Settings::DEFAULT
    };
    let mut solver = Solver::new().with_settings(config);
    let first = solver.first_contact(a, b, 1.0).unwrap();
    let any = solver.any_contact(a, b, 1.0).unwrap();
    let closest = solver.closest_approach(a, b, 1.0).unwrap();
    if gap > 0.0 {
        assert!(matches!(first.outcome, Outcome::Free { .. }), "{first:?}");
        assert!(matches!(any.outcome, Outcome::Free { .. }), "{any:?}");
    } else {
        assert!(
            matches!(first.outcome, Outcome::Contact { .. }),
            "{first:?}"
        );
        assert!(matches!(any.outcome, Outcome::Contact { .. }), "{any:?}");
    }
    let (lower, upper) = (closest.outcome.lower(), closest.outcome.upper());
    // The coordinates are at most 4.
    let rounding = 1e-14;
    assert!(
        lower <= gap + rounding
            && gap - rounding <= upper
            && upper - lower <= greater(tolerance, 2e-12),
        "{gap:e}: {lower:e} {upper:e} {closest:?}"
    );
    let visits = [first.stats, any.stats, closest.stats].map(|stats| stats.iterations);
    visits.into_iter().max().unwrap()
}

/// Returns the least height of a trajectory whose height has a single minimum.
fn least_height(trajectory: &dyn Trajectory) -> f64 {
    let height = |time: f64| trajectory.pose(time).unwrap().translation().z;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..100 {
        let [one, other] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if height(one) < height(other) {
            high = other;
        } else {
            low = one;
        }
    }
    height(0.5 * (low + high))
}
