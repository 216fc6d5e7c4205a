use super::*;
use ccd_core::Pose;
use std::f64::consts::PI;

fn motion_with_extent(
    place: [f64; 3],
    velocity: [f64; 3],
    spin: [f64; 3],
    reach: f64,
) -> MotionWithExtent {
    let pose = Pose::at(place).expect("a pose");
    MotionWithExtent {
        motion: Motion::new(pose, velocity, spin).expect("a motion"),
        about: DVec3::ZERO,
        max_radius: reach,
    }
}

fn resting_motion(reach: f64) -> MotionWithExtent {
    motion_with_extent([0.0; 3], [0.0; 3], [0.0; 3], reach)
}

#[test]
fn the_horizon_ends_when_bodies_have_passed() {
    for speed in [1e-30, 1.0, 1e30] {
        let flies = motion_with_extent([-4.0, 0.0, 0.0], [speed, 0.0, 0.0], [0.0; 3], 1.0);
        let QueryDuration::WholeCast(duration) =
            QueryDuration::new([flies, resting_motion(2.0)], 0.5, f64::INFINITY)
        else {
            panic!("it passes");
        };
        // They are apart again 3.5 beyond the middle.
        let exact = 7.5 / speed;
        assert!(
            duration >= exact && duration < exact * (1.0 + 1e-12),
            "{speed:e}: {duration:e}"
        );
        let short = QueryDuration::new([flies, resting_motion(2.0)], 0.5, 0.1 * exact);
        assert_eq!(short, QueryDuration::WholeCast(0.1 * exact));
    }
}

#[test]
fn the_horizon_of_periodic_motions_is_one_period() {
    let turns = |spin| motion_with_extent([0.0; 3], [0.0; 3], spin, 1.0);
    let both =
        |a: [f64; 3], b: [f64; 3]| QueryDuration::new([turns(a), turns(b)], 0.0, f64::INFINITY);
    assert_eq!(both([0.0; 3], [0.0; 3]), QueryDuration::WholeCast(0.0));
    for horizon in [
        both([0.0, 2.0, 0.0], [0.0; 3]),
        both([0.0; 3], [0.0, 2.0, 0.0]),
        both([2.0, 0.0, 0.0], [2.0, 0.0, 0.0]),
    ] {
        let QueryDuration::WholeCast(duration) = horizon else {
            panic!("it repeats itself");
        };
        assert!((PI..PI + 1e-10).contains(&duration), "{duration}");
    }
    assert!(
        matches!(both([2.0, 0.0, 0.0], [0.0, 2.0, 0.0]), QueryDuration::PartOfCast(duration) if duration > 1e5)
    );
}

#[test]
fn travel_and_turn_stay_within_the_engines_limits() {
    let spins = motion_with_extent([-4.0, 0.0, 0.0], [1e-9, 0.0, 0.0], [0.0, 0.0, 1e3], 1.0);
    let QueryDuration::PartOfCast(duration) =
        QueryDuration::new([spins, resting_motion(1.0)], 0.0, 1e9)
    else {
        panic!("it turns too often");
    };
    assert!(duration * 1e3 < MAX_ROTATION_ANGLE && duration * 1e3 > 0.99 * MAX_ROTATION_ANGLE);
    // Both bodies are fast, but have almost no relative velocity.
    let [a, b] =
        [1e9, 1e9 + 1e-3].map(|v| motion_with_extent([0.0; 3], [v, 0.0, 0.0], [0.0; 3], 1e3));
    let QueryDuration::PartOfCast(duration) = QueryDuration::new([a, b], 0.0, f64::INFINITY) else {
        panic!("it flies too far");
    };
    assert!(duration * 1e9 < MAX_COORDINATE && duration * 1e9 > 0.99 * MAX_COORDINATE);
}
