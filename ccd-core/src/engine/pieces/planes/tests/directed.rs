//! Tests that a free time along an axis is the gap divided by the sum of both bodies' velocity bounds.

use super::super::*;
use crate::engine::meter::Meter;
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{RngExt, SceneKind, rng, scene};

/// Returns the sum of both bodies' velocity bounds along a normal from A to B.
fn rate(placed: &PlacedPair<'_>, normal: DVec3, bound: VelocityBound, reaches: [f64; 2]) -> f64 {
    let Problem { a, b, .. } = placed.problem;
    let sides = [(a, normal, placed.pieces.a), (b, -normal, placed.pieces.b)];
    let mut sum = 0.0;
    for (k, (side, n, piece)) in sides.into_iter().enumerate() {
        let motion = side.path.velocities();
        let arms = piece
            .points
            .iter()
            .map(|&x| placed.frames[k].rotation * (x - side.path.center));
        let farthest = |along: DVec3| {
            let all = arms.clone();
            all.max_by(|p, q| along.dot(*p).total_cmp(&along.dot(*q)))
                .unwrap()
        };
        sum += match bound {
            VelocityBound::Sound => sound_bound(&motion, n, reaches[k]),
            VelocityBound::Published => published_bound(&motion, n, farthest),
        };
    }
    sum
}

/// Returns the sum of the greatest speeds of both pieces' points; the rounding of rates is a share of it.
fn max_speed_sum(problem: &Problem<'_>, reaches: [f64; 2]) -> f64 {
    let sides = [&problem.a, &problem.b];
    let speeds = sides.iter().zip(reaches).map(|(side, reach)| {
        let motion = side.path.velocities();
        length(motion.linear_velocity) + length(motion.spin) * reach
    });
    speeds.sum()
}

#[test]
fn a_directed_time_is_the_gap_over_both_advances() {
    let mut rng = rng(7);
    let mut counts = [[0; 2]; 2];
    for number in 0..3_000 {
        let kind = SceneKind::passing(number);
        let scene = scene(&mut rng, kind, 2);
        let problem = scene.problem();
        let placed = PlacedPair::new(&problem, [0, 0], scene.clock * rng.random_range(0.0..1.0));
        let mut meter = Meter::new(&problem);
        let checked = placed
            .query_oracle(&mut ExhaustiveOracle, &mut (), &mut meter)
            .unwrap();
        let kept = problem.kept_gap();
        if checked.lower <= 2.0 * kept {
            continue;
        }
        let reaches = [&problem.a, &problem.b].map(|side| {
            side.path
                .max_distance_from_axis(side.body.pieces().points())
        });
        let normal = placed.frames[0].rotation * checked.axis;
        let allowance = RATE_ERROR_F64 * max_speed_sum(&problem, reaches);
        for (k, bound) in [VelocityBound::Sound, VelocityBound::Published]
            .into_iter()
            .enumerate()
        {
            let rate = rate(&placed, normal, bound, reaches);
            let expected = (checked.lower - kept) / rate;
            let horizon = 1.0 - placed.clock;
            let time = placed.free_time_along_axis(&checked, kept, bound, reaches);
            let time = time.bounded();
            match time {
                Some(time) => {
                    let allowed = ((checked.lower - kept) / time - rate) / allowance;
                    assert!((0.4..3.0).contains(&allowed), "{bound:?}: {allowed}");
                }
                None => assert!(rate <= 0.0 || expected >= horizon * (1.0 - 1e-9)),
            }
            counts[k][usize::from(time.is_some())] += 1;
        }
    }
    let each = counts.concat();
    assert!(each.iter().all(|&count| count > 100), "{counts:?}");
}
