//! Near misses cost little more than wide ones.

use ccd_core::glam::DVec3;
use ccd_core::schedule::{BestFirst, Schedule};
use ccd_core::{Body, Config, Motion, Outcome, Pose, Problem};
use ccd_distance_gjk::Gjk;
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
