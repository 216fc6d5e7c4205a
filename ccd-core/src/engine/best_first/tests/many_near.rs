//! Tests that many pairs of near triangles need few visits, in flat contact and in screw threads.

use super::*;
use glam::DQuat;

/// Tests that two plates whose triangles all meet at the same time need fewer than 100 visits. The least tolerance is
/// one that f32 cannot distinguish from contact.
#[test]
fn plates_that_fall_flat_meet_at_little_cost() {
    const SQUARES_PER_SIDE: usize = 24;
    let own = DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7);
    let corner = |i: usize, j: usize| {
        let [x, y] = [i, j].map(|k| k as f64 / SQUARES_PER_SIDE as f64 - 0.5);
        own * DVec3::new(x, y, 0.0)
    };
    let square = |k: usize| {
        let (i, j) = (k / SQUARES_PER_SIDE, k % SQUARES_PER_SIDE);
        let (b, d) = (corner(i + 1, j), corner(i, j + 1));
        [[corner(i, j), b, d], [b, corner(i + 1, j + 1), d]]
    };
    let plate = body(
        &(0..SQUARES_PER_SIDE * SQUARES_PER_SIDE)
            .flat_map(square)
            .collect::<Vec<_>>(),
    );
    for tolerance in [1e-3, 1e-7, 1e-9] {
        let config = Settings {
            tolerance,
            ..Settings::DEFAULT
        };
        let above = Pose::new(
            [0.013, 0.007, 1.0],
            DQuat::from_rotation_z(0.3) * own.inverse(),
        );
        let falling = Motion::new(above.unwrap(), -2.0 * DVec3::Z, DVec3::ZERO).unwrap();
        let lying = Motion::still(Pose::new([0.0; 3], own.inverse()).unwrap());
        let problem =
            Problem::of_moving_bodies((&plate, falling), (&plate, lying), 1.0, &config).unwrap();
        let answer = solve(&problem);
        let Outcome::Contact { time, .. } = answer.outcome else {
            panic!("{answer:?}");
        };
        assert!(time <= 0.5 && time >= 0.5 - 0.5 * tolerance, "{time}");
        assert!(answer.stats.iterations < 100, "{:?}", answer.stats);
    }
}

/// Returns the triangles of a right-handed thread about z with a pitch of 1. The arguments are the distances of root
/// and crest from the axis.
fn screw_thread(root: f64, crest: f64, turns: usize) -> Vec<Triangle> {
    const SEGMENTS_PER_TURN: usize = 24;
    let profile = [
        (root, 0.0),
        (root, 0.25),
        (crest, 0.5),
        (crest, 0.75),
        (root, 1.0),
    ];
    let corner = |k: usize, p: usize| {
        let turn = k as f64 / SEGMENTS_PER_TURN as f64;
        let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
        let (r, z) = profile[p];
        DVec3::new(r * cos, r * sin, z + turn)
    };
    let strip = |k: usize| {
        (0..profile.len() - 1).flat_map(move |p| {
            let (b, d) = (corner(k + 1, p), corner(k, p + 1));
            [[corner(k, p), b, d], [b, corner(k + 1, p + 1), d]]
        })
    };
    (0..turns * SEGMENTS_PER_TURN).flat_map(strip).collect()
}

/// Tests that a bolt turns through a nut without contact in fewer than 60,000 visits, and meets the nut if it advances
/// by more than its pitch.
#[test]
fn a_bolt_is_screwed_through_a_nut_at_little_cost() {
    let (bolt, nut) = (
        body(&screw_thread(2.0, 2.4, 5)),
        body(&screw_thread(2.15, 2.55, 3)),
    );
    let config = Settings {
        tolerance: 1e-4,
        ..Settings::DEFAULT
    };
    let answer = |advance: f64| {
        let spin = 2.0 * std::f64::consts::TAU * DVec3::Z;
        let screwing = Motion::new(Pose::IDENTITY, advance * DVec3::Z, spin).unwrap();
        solve(
            &Problem::of_moving_bodies((&bolt, screwing), (&nut, Motion::STILL), 1.0, &config)
                .unwrap(),
        )
    };
    // Two turns at the bolt's pitch. Without profiles this takes 680,000 visits.
    let right = answer(2.0);
    assert!(matches!(right.outcome, Outcome::Free { .. }), "{right:?}");
    assert!(right.stats.iterations < 60_000, "{:?}", right.stats);
    // A thread that advances relative to the other one meets it before long.
    let wrong = answer(2.5);
    let Outcome::Contact { time, .. } = wrong.outcome else {
        panic!("{wrong:?}");
    };
    let problem = |s: f64| s * 0.5 * 0.25;
    assert!(problem(time) < 0.15, "{time}");
}

/// Tests that long needles that turn about an axis along themselves meet in fewer than 1,000 visits. Such a rotation
/// uses up none of the gap along the needles.
#[test]
fn long_needles_that_turn_about_their_own_direction_meet_at_little_cost() {
    for (length, tolerance) in [(10.0, 1e-5), (1.0, 1e-9), (10.0, 1e-9)] {
        let axis = DVec3::new(0.48, 0.6, 0.64);
        let (x, y) = axis.any_orthonormal_pair();
        let needle = |angle: f64, [low, high]: [f64; 2]| {
            let at = |angle: f64, z: f64| angle.cos() * x + angle.sin() * y + z * axis;
            [
                at(angle - 1e-3, low),
                at(angle + 1e-3, low),
                at(angle, high),
            ]
        };
        let steps = |k: u32| 0.02 * f64::from(k);
        let needles =
            |needle: &dyn Fn(u32) -> Triangle| body(&(0..8).map(needle).collect::<Vec<_>>());
        let moving = needles(&|k| needle(-steps(k), [0.0, 2.0 * length]));
        let still = needles(&|k| needle(1.0 + steps(k), [2.0 * length, 0.0]));
        let config = Settings {
            tolerance,
            ..Settings::DEFAULT
        };
        let turning = Motion::new(Pose::IDENTITY, DVec3::ZERO, 1.5 * axis).unwrap();
        let problem =
            Problem::of_moving_bodies((&moving, turning), (&still, Motion::STILL), 1.0, &config)
                .unwrap();
        let answer = solve(&problem);
        let Outcome::Contact { time, .. } = answer.outcome else {
            panic!("{answer:?}");
        };
        assert!((time - 1.0 / 1.5).abs() < 3e-3, "{time}");
        assert!(
            answer.stats.iterations < 1_000,
            "{length} {tolerance}: {:?}",
            answer.stats
        );
    }
}
