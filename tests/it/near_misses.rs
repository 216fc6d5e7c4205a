//! Near misses cost little more than wide ones.

use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::schedule::{BestFirst, Schedule};
use ccd_core::{Body, Config, Motion, Outcome, Pose, Problem};
use ccd_distance_gjk::Gjk;
use rigid_ccd::trajectory::{Chain, Curve, Joint, Spline, Steady, Trajectory, Turns};
use rigid_ccd::{Solver, Travelling};
use std::f64::consts::PI;

/// T6: a rod turns past a wall that its corners just do not reach. All of a gap is left to advance by when a
/// corner is nearest; what the other corners do then must not matter.
#[test]
fn a_rod_that_turns_past_a_wall_takes_few_steps() {
    let (thin, long) = (0.05, 2.0f64);
    let rod = Body::cuboid([thin, 0.3, long]).unwrap();
    let wall = Body::cuboid([1.0, 3.0, 3.0]).unwrap();
    let turning = Motion::new(Pose::IDENTITY, DVec3::ZERO, PI * DVec3::Y).unwrap();
    for exponent in 1..=10 {
        let gap = 10f64.powi(-exponent);
        let away = Pose::at((long.hypot(thin) + gap + 1.0) * DVec3::X).unwrap();
        let config = Config {
            tolerance: 0.25 * gap,
            ..Config::default()
        };
        let problem = Problem::new((&rod, turning), (&wall, Motion::still(away)), 1.0, &config);
        let answer = BestFirst::default().solve(&problem.unwrap(), &mut Gjk);
        assert!(matches!(answer.outcome, Outcome::Free { .. }), "{answer:?}");
        assert!(answer.stats.iterations <= 2, "{gap}: {:?}", answer.stats);
    }
}

/// A ball past a box: straight along a face, on a curve that comes down to it, and as the hand of an arm. A
/// straight way takes as many steps at any gap. A curve is cut into stretches that strays fit into: some more for
/// each digit of the gap.
#[test]
fn a_ball_past_a_box_takes_few_steps() {
    let radius = 0.25;
    let (ball, cube) = (Body::ball(radius).unwrap(), Body::cuboid([1.0; 3]).unwrap());
    let at = |z: f64| Pose::at([0.0, 0.0, z]).unwrap();
    let aside = Pose::at([-3.0, 0.0, 0.0]).unwrap();
    let straight = Motion::new(aside, [6.0, 0.0, 0.0], [0.0; 3]).unwrap();
    let points = [
        [-3.0, 0.0, 2.0],
        [-1.0, 0.0, -1.0],
        [1.0, 0.0, -1.0],
        [3.0, 0.0, 2.0],
    ];
    // The lowest point, at half the time, is at -1/4.
    let curve = Spline::new(Curve::bezier(&points, 1.0).unwrap(), Turns::NONE);
    let joint = |z: f64| Joint::revolute(at(z), [0.0, 1.0, 0.0]).unwrap();
    // Stretched downwards at half the time.
    let joints = vec![joint(0.0), joint(-1.0), Joint::fixed(at(-1.0))];
    let chain = Chain::new(Pose::IDENTITY, joints);
    let hand = (chain.link(3, &[-1.0, -1.0, 0.0], &[1.0, 1.0, 0.0], 1.0)).unwrap();
    let ways: [(&dyn Trajectory, f64, [u64; 2]); 3] = [
        (&Steady(straight), 0.0, [8, 0]),
        (&curve, -0.25, [30, 40]),
        (&hand, -2.0, [30, 40]),
    ];
    for (trajectory, lowest, [most, more]) in ways {
        let a = Travelling {
            body: &ball,
            trajectory,
        };
        for digits in [1, 3, 6, 9, 12] {
            let gap = 10f64.powi(-digits);
            let below = Motion::still(at(lowest - radius - gap - 1.0));
            let b = (&cube, &below);
            let config = Config {
                tolerance: 0.25 * gap,
                ..Config::default()
            };
            let mut solver = Solver::new().with_config(config);
            let first = solver.answer_along(a, b, 1.0).unwrap();
            assert!(matches!(first.outcome, Outcome::Free { .. }), "{first:?}");
            let any = solver.any_contact_along(a, b, 1.0).unwrap();
            let closest = solver.closest_approach_along(a, b, 1.0).unwrap();
            let (lower, upper) = (closest.outcome.lower(), closest.outcome.upper());
            // Of coordinates up to 4.
            let rounding = 1e-14;
            assert!(
                lower <= gap + rounding
                    && gap - rounding <= upper
                    && upper - lower <= greater(0.25 * gap, 2e-12),
                "{gap:e}: {lower:e} {upper:e} {closest:?}"
            );
            let most = most + more * digits as u64;
            for stats in [first.stats, any.stats, closest.stats] {
                assert!(stats.iterations <= most, "{gap}: {stats:?}");
            }
        }
    }
}
