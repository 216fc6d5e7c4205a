//! Tests edges with thousands of turns, with tiny motions, far from the base, or with many joints, against independent
//! arithmetic.

use super::tolerances::{BallArm, BallJoint, random_offset};
use super::*;

/// Returns a path of a few segments in which joints turn far, slightly or not at all.
fn hostile_path(random: &mut Pcg64, joints: &[BallJoint], scale: f64) -> Vec<Vec<f64>> {
    let start = joints.iter().map(|_| random.random_range(-1.0..1.0));
    let mut path: Vec<Vec<f64>> = vec![start.collect()];
    for _ in 0..random.random_range(1..4) {
        let change = |joint: &BallJoint| {
            let size = match random.random_range(0..4) {
                0 => 0.0,
                1 => 1e-12,
                2 => 1.0,
                _ if joint.turns => 500.0,
                _ => scale,
            };
            size * random.random_range(-1.0..1.0)
        };
        let last = &path[path.len() - 1];
        let changes: Vec<f64> = joints.iter().map(change).collect();
        let next = last.iter().zip(changes).map(|(last, change)| last + change);
        path.push(next.collect());
    }
    path
}

fn position(path: &[Vec<f64>], time: f64) -> Vec<f64> {
    let segment = (time as usize).min(path.len() - 2);
    configuration_between(&path[segment], &path[segment + 1], time - segment as f64)
}

/// Tests that no first contact is late, that each is within the margin and the reported tolerance, and that no sample
/// is nearer than the least distance.
#[test]
fn hostile_edges_keep_the_tolerance_that_they_state() {
    let mut random = Pcg64::seed_from_u64(76);
    let [mut free, mut contacts, mut raised, mut unresolved] = [0; 4];
    for number in 0..400 {
        let scale = 10f64.powf(random.random_range(-2.0..6.0));
        let count = [1, 2, 3, 30][random.random_range(0..4)];
        let joints: Vec<BallJoint> = (0..count)
            .map(|_| BallJoint {
                offset: random_offset(&mut random) * [0.1, scale][usize::from(count < 4)],
                axis: random_offset(&mut random).normalize(),
                turns: random.random_range(0..2) == 0,
            })
            .collect();
        let path = hostile_path(&mut random, &joints, scale);
        let end = (path.len() - 1) as f64;
        let aimed = position(&path, random.random_range(0.0..end));
        let arm = BallArm::new(joints, DVec3::ZERO);
        let beside = random_offset(&mut random).normalize() * random.random_range(0.0..0.8);
        let at = arm.ball(&aimed) + beside;
        let arm = BallArm::new(arm.joints, at);
        let margin = [0.0, 0.3][number % 2];
        let settings = Settings {
            margin,
            tolerance: 10f64.powf(random.random_range(-10.0..-3.0)),
            budget: 20_000,
            ..Settings::DEFAULT
        };
        let tolerance = settings.tolerance;
        let mut solver = arm.cell.solver().with_settings(settings);
        // The rounding error of the referee: angles, and the lengths of all joints.
        let size = 1.0 + count as f64 * ccd_core::order::greater(scale, 1.0);
        let rounding = 4096.0 * f64::EPSILON * size;
        let answer = solver.first_contact(&path).unwrap();
        let (outcome, met) = (answer.outcome, answer.tolerance);
        raised += usize::from(met > tolerance);
        let until = match outcome {
            PathOutcome::Free => end,
            PathOutcome::Contact(contact) => {
                contacts += 1;
                let distance = arm.distance(&position(&path, contact.at.time()));
                assert!(
                    distance <= margin + 1.001 * met + rounding,
                    "{number}: {distance} of {met} {tolerance} {scale}"
                );
                contact.at.time()
            }
            _ => {
                unresolved += 1;
                answer.free_until.time()
            }
        };
        free += usize::from(outcome == PathOutcome::Free);
        let closest = solver.closest_approach(&path).unwrap().outcome;
        if closest.limit().is_none() {
            let width = closest.upper() - closest.lower();
            assert!(
                width <= 1.001 * solver.met_tolerance(),
                "{number}: {closest:?}"
            );
        }
        let samples = (0..2000).map(|k| end * f64::from(k) / 2000.0);
        for time in samples {
            let distance = arm.distance(&position(&path, time));
            assert!(
                time >= until || distance > margin - rounding,
                "{number}: {distance} at {time} before {until}"
            );
            assert!(
                greater(distance, 0.0) >= closest.lower() - rounding,
                "{number}: {distance} at {time}: {closest:?}"
            );
        }
    }
    assert!(
        free > 50 && contacts > 100 && raised > 20 && unresolved < 200,
        "{free} {contacts} {raised} {unresolved}"
    );
}
