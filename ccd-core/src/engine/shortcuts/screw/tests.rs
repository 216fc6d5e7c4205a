//! Compares nodes proven apart along a screw with distances at sampled times.

mod worst;

use super::*;
use crate::body::Body;
use crate::math::order::{greater, lesser};
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::settings::Settings;
use crate::tests::nearest::{Triangle, nearest_points};
use crate::tests::scene::{
    Pcg64, RngExt, body, random_direction, random_point_in_ball, random_power_of_ten,
    random_rotation, rng,
};
use glam::{DQuat, DVec3};

/// Draws a few random triangles that are all near one point.
fn random_triangle_cluster(rng: &mut Pcg64, at: DVec3, size: f64) -> Vec<Triangle> {
    let count = rng.random_range(1..6);
    let mut corner = || at + random_point_in_ball(rng, size);
    (0..count).map(|_| [corner(), corner(), corner()]).collect()
}

/// Two bodies, one of which moves along a screw past the other. Some of them make thousands of turns before. The moving
/// body passes the other after a share of the turn.
struct ScrewPassage {
    bodies: [Body; 2],
    screw_motion: Motion,
    still: Motion,
    /// The clock at which the bodies are near each other.
    passage_clock: f64,
}

fn random_screw_passage(rng: &mut Pcg64) -> ScrewPassage {
    let (size, distance) = (
        random_power_of_ten(rng, -2.0, -0.5),
        rng.random_range(0.8..1.5),
    );
    let axis = random_direction(rng);
    let out = axis.any_orthonormal_vector();
    let turn = if rng.random_bool(0.75) {
        rng.random_range(0.1..20.0)
    } else {
        random_power_of_ten(rng, 1.0, 5.0)
    };
    let advance = [0.0, rng.random_range(-0.3..0.3)][rng.random_range(0..2)];
    let near = rng.random_range(0.0..1.0);
    let at = distance * out;
    let there = DQuat::from_axis_angle(axis, near * turn) * at + near * turn * advance * axis;
    let beside = there + random_point_in_ball(rng, 2.0 * size);
    let (place, own) = (random_point_in_ball(rng, 3.0), random_rotation(rng));
    let moving = random_triangle_cluster(rng, at, size);
    // The body's own frame is turned about its origin, which is on the axis.
    let moving = moving.map_corners(|x| own.inverse() * x);
    let still = random_triangle_cluster(rng, beside + place, size);
    let drift = [0.0, 1e-5][rng.random_range(0..2)] * out;
    let velocity = turn * advance * axis + drift;
    ScrewPassage {
        bodies: [body(&moving), body(&still)],
        screw_motion: Motion::new(Pose::new(place, own).unwrap(), velocity, turn * axis).unwrap(),
        still: Motion::still(Pose::IDENTITY),
        passage_clock: near,
    }
}

trait MapCorners {
    fn map_corners(self, f: impl Fn(DVec3) -> DVec3) -> Self;
}

impl MapCorners for Vec<Triangle> {
    fn map_corners(self, f: impl Fn(DVec3) -> DVec3) -> Self {
        self.into_iter().map(|t| t.map(&f)).collect()
    }
}

/// Returns all pairs of ids of a root or triangle of A and a root or triangle of B, for bodies whose only node is the
/// root.
fn all_node_pairs(problem: &Problem<'_>) -> Vec<[NodeId; 2]> {
    let ids = |side: &BodyWithPath<'_>| 0..=side.body.pieces().len() as NodeId;
    let of_a = ids(&problem.a);
    of_a.flat_map(|a| ids(&problem.b).map(move |b| [a, b]))
        .collect()
}

/// Returns the least distance of two nodes at sampled times from `s` on, most of them near the time `near`.
fn sampled_least_distance(problem: &Problem<'_>, [a, b]: [NodeId; 2], s: f64, near: f64) -> f64 {
    let triangles = |side: &BodyWithPath<'_>, id: NodeId, s: f64| -> Vec<Triangle> {
        let (frame, pieces) = (side.path.frame(s), side.body.pieces());
        let all = 0..pieces.len();
        let below = all.filter(|&k| id == 0 || k + 1 == id as usize);
        below
            .map(|k| pieces.triangle(k).map(|x| frame.transform_point(x)))
            .collect()
    };
    let distance = |s: f64| {
        let (a, b) = (triangles(&problem.a, a, s), triangles(&problem.b, b, s));
        let pairs = a
            .iter()
            .flat_map(|x| b.iter().map(move |y| nearest_points(x, y).distance));
        pairs.fold(f64::INFINITY, lesser)
    };
    let even = (0..200).map(|k| f64::from(k) / 199.0);
    // No step turns by more than a few thousandths of a radian.
    let step = 2e-4
        * lesser(
            1.0,
            20.0 / greater(problem.a.path.angular_speed, problem.b.path.angular_speed),
        );
    let dense = (-100..=100).map(|k| near + f64::from(k) * step);
    let times = even.chain(dense).filter(|t| (s..=1.0).contains(t));
    times.map(distance).fold(f64::INFINITY, lesser)
}

#[test]
fn nodes_said_to_stay_apart_do_so_at_sampled_times() {
    let mut rng = rng(1);
    let (mut proven, mut missed) = (0, 0);
    for number in 0..600 {
        let passage = random_screw_passage(&mut rng);
        let [a, b] = &passage.bodies;
        let config = Settings {
            tolerance: random_power_of_ten(&mut rng, -6.0, -2.0),
            ..Settings::DEFAULT
        };
        let (mut first, mut second) = ((a, passage.screw_motion), (b, passage.still));
        if number % 2 == 1 {
            std::mem::swap(&mut first, &mut second);
        }
        // Both bodies have the same acceleration, or nearly.
        let pull = random_direction(&mut rng) * [0.0, 3.0][number / 2 % 2];
        let pulls = [pull, pull * (1.0 + [0.0, 1e-3][number / 4 % 2])];
        let bodies = [first, second];
        let problem =
            Problem::with_accelerations(bodies, pulls, 1.0, &config.to_query_settings()).unwrap();
        // The axis may move too fast for small bodies.
        let mut profiles = ProfileCache::default();
        let Some(screw) = Screw::for_problem(&problem, &mut profiles) else {
            continue;
        };
        let s = [0.0, 0.5 * passage.passage_clock][rng.random_range(0..2)];
        for ids in all_node_pairs(&problem) {
            match screw.free_time(&problem, &mut profiles, ids, s) {
                Some(FreeTime::ToEnd) => {
                    proven += 1;
                    let least = sampled_least_distance(&problem, ids, s, passage.passage_clock);
                    assert!(
                        least > problem.kept_node_gap(),
                        "{number} {ids:?}: {least:e}"
                    );
                }
                _ => missed += 1,
            }
        }
    }
    assert!(
        proven > 4_000 && missed > 400,
        "{proven} of them proven, {missed} not"
    );
}

/// Tests that a screw motion which meets the other body in its second turn is proven apart for one turn, but not for
/// two.
#[test]
fn later_turns_count() {
    let triangle = |at: DVec3| [at, at + 0.02 * DVec3::Z, at + 0.02 * DVec3::X];
    let moving = body(&[triangle(DVec3::X)]);
    // The triangle is at the place that is reached after a turn and a half.
    let still = body(&[triangle(DVec3::new(-1.0, 0.0, 0.3))]);
    let turn = |turns: f64| {
        Motion::new(
            Pose::IDENTITY,
            0.2 * turns * DVec3::Z,
            turns * TAU * DVec3::Z,
        )
        .unwrap()
    };
    for (turns, apart) in [(1.0, true), (2.0, false)] {
        let config = Settings::DEFAULT;
        let moving = (&moving, turn(turns));
        let problem =
            Problem::of_moving_bodies(moving, (&still, Motion::STILL), 1.0, &config).unwrap();
        let mut profiles = ProfileCache::default();
        let screw = Screw::for_problem(&problem, &mut profiles).unwrap();
        assert_eq!(
            screw.free_time(&problem, &mut profiles, [1, 1], 0.0),
            Some(FreeTime::to_end_if(apart)),
            "{turns}"
        );
    }
}

/// Tests that nodes are proven apart over any number of turns at once, with and without an advance along the axis. A
/// node as tall as many pitches is apart from a node outside of all of them, and meets others.
#[test]
fn any_number_of_turns_is_one_look() {
    let triangle = |r: f64, tall: f64| {
        let at = r * DVec3::X;
        body(&[[at, at + 0.02 * DVec3::Y, at + tall * DVec3::Z]])
    };
    let config = Settings::DEFAULT;
    for (pitch, turns, r, tall, apart) in [
        (0.0, 1e5, 1.1, 0.02, true),
        (0.0, 1e5, 1.0, 0.02, false),
        (1e-3, 1e3, 1.1, 0.8, true),
        (1e-3, 1e3, 1.0, 0.8, false),
        (-1e-2, 1e3, 1.1, 20.0, true),
        // Between the turns of a thread there is room for a flat node.
        (0.5, 1e3, 1.0, 0.01, true),
        (0.5, 1e3, 1.0, 0.6, false),
    ] {
        let (moving, still) = (triangle(1.0, 0.02), triangle(r, tall));
        let below = match pitch {
            0.0 => 0.0,
            pitch if pitch < 0.0 => 5.0,
            _ => -0.25,
        };
        let spin = Motion::new(
            Pose::at(below * DVec3::Z).unwrap(),
            pitch * turns * DVec3::Z,
            turns * TAU * DVec3::Z,
        );
        let moving = (&moving, spin.unwrap());
        let problem =
            Problem::of_moving_bodies(moving, (&still, Motion::STILL), 1.0, &config).unwrap();
        let mut profiles = ProfileCache::default();
        let screw = Screw::for_problem(&problem, &mut profiles).unwrap();
        assert_eq!(
            screw.free_time(&problem, &mut profiles, [1, 1], 0.0),
            Some(FreeTime::to_end_if(apart)),
            "{pitch} {turns} {r} {tall}"
        );
    }
}

#[test]
fn what_is_no_screw_has_no_profiles() {
    let cube = body(&crate::tests::meshes::cube(0.5, 2));
    let motion = |velocity: DVec3, spin: DVec3| {
        Motion::new(Pose::at(3.0 * DVec3::X).unwrap(), velocity, spin).unwrap()
    };
    let config = Settings::DEFAULT;
    let is_screw = |a: Motion, b: Motion| {
        let problem = Problem::of_moving_bodies((&cube, a), (&cube, b), 1.0, &config).unwrap();
        Screw::for_problem(&problem, &mut ProfileCache::default()).is_some()
    };
    let still = Motion::STILL;
    assert!(is_screw(motion(DVec3::Z, DVec3::Z), still));
    assert!(is_screw(still, motion(DVec3::ZERO, DVec3::X)));
    assert!(!is_screw(motion(DVec3::X, DVec3::Z), still));
    assert!(!is_screw(motion(DVec3::Z, DVec3::ZERO), still));
    assert!(!is_screw(
        motion(DVec3::Z, DVec3::Z),
        motion(DVec3::ZERO, DVec3::Z)
    ));
    let falls = |pulls: [DVec3; 2]| {
        let bodies = [(&cube, motion(DVec3::Z, DVec3::Z)), (&cube, still)];
        let problem =
            Problem::with_accelerations(bodies, pulls, 1.0, &config.to_query_settings()).unwrap();
        Screw::for_problem(&problem, &mut ProfileCache::default()).is_some()
    };
    assert!(falls([9.8 * DVec3::X; 2]));
    assert!(!falls([9.8 * DVec3::X, DVec3::ZERO]));
    assert!(!falls([DVec3::ZERO, 9.8 * DVec3::Z]));
}

/// Tests that tall nodes far along an oblique axis are not proven apart from bodies at their tips, despite rounding.
#[test]
fn tall_nodes_far_along_an_oblique_axis_meet_what_is_at_their_tips() {
    const TRIANGLE_COUNT: usize = 8;
    let mut rng = rng(5);
    let mut pairs = 0;
    for _ in 0..60 {
        let axis = random_direction(&mut rng);
        let (x, y) = axis.any_orthonormal_pair();
        let (length, high) = (
            random_power_of_ten(&mut rng, 4.0, 6.0),
            random_power_of_ten(&mut rng, 4.0, 7.0),
        );
        let at = |angle: f64, r: f64, z: f64| {
            r * (angle.cos() * x + angle.sin() * y) + (high + z * length) * axis
        };
        let azimuth = |k: usize| 0.3 * k as f64 / TRIANGLE_COUNT as f64;
        // Their tips are at a distance of 1 from the axis, and the others' bases at a little less.
        let tall = |k: usize| {
            let angle = -azimuth(k);
            let foot = |side: f64| at(angle + side * 1e-3, 0.99, -1.0);
            [foot(-1.0), foot(1.0), at(angle, 1.0, 1.0)]
        };
        let depth = [0.0, 1e-5, 1e-4][rng.random_range(0..3)];
        let beside = |k: usize| {
            let at = |r: f64, z: f64| at(1.0 + azimuth(k), r, z);
            [
                at(1.0 - depth, 1.0 - 1e-7),
                at(1.0 - depth, 1.0 + 1e-7),
                at(1.05, 1.0 + 1e-7),
            ]
        };
        let bodies = [
            (0..TRIANGLE_COUNT).map(tall).collect::<Vec<_>>(),
            (0..TRIANGLE_COUNT).map(beside).collect(),
        ];
        let [moving, still] = bodies.map(|triangles| body(&triangles));
        let turning = Motion::new(Pose::IDENTITY, DVec3::ZERO, 1.7 * axis).unwrap();
        let problem = Problem::of_moving_bodies(
            (&moving, turning),
            (&still, Motion::STILL),
            1.0,
            &Settings::DEFAULT,
        );
        let problem = problem.unwrap();
        let mut profiles = ProfileCache::default();
        let screw = Screw::for_problem(&problem, &mut profiles).unwrap();
        // Each of the tall nodes passes each of the others on its path.
        for pair in all_node_pairs(&problem) {
            assert_ne!(
                screw.free_time(&problem, &mut profiles, pair, 0.0),
                Some(FreeTime::ToEnd),
                "{length} {high} {depth}"
            );
            pairs += 1;
        }
    }
    assert!(pairs > 3_000, "{pairs}");
}
