//! Bodies with surfaces that stay beside each other while one of them turns.

use super::*;
use crate::config::Config;
use crate::motion::pose::Pose;
use crate::tests::nearest::Triangle;
use crate::tests::scene::body;
use glam::DVec3;
use std::f64::consts::TAU;

/// The triangles of a surface of revolution about z; a ring of corners at each radius and height.
fn revolved(outline: &[[f64; 2]], count: u32) -> Vec<Triangle> {
    let at = |[r, z]: [f64; 2], k: u32| {
        let (sin, cos) = (TAU * f64::from(k % count) / f64::from(count)).sin_cos();
        DVec3::new(r * cos, r * sin, z)
    };
    let strip = |pair: &[[f64; 2]]| {
        let [low, high] = [pair[0], pair[1]];
        let quad = move |k| [at(low, k), at(low, k + 1), at(high, k + 1), at(high, k)];
        let halves = |[a, b, c, d]: [DVec3; 4]| [[a, b, c], [a, c, d]];
        (0..count)
            .flat_map(move |k| halves(quad(k)))
            .collect::<Vec<_>>()
    };
    outline.windows(2).flat_map(strip).collect()
}

/// Part of a sphere about the origin, from one angle with the axis to another.
fn spherical(radius: f64, angles: [f64; 2], count: u32) -> Vec<Triangle> {
    let [from, to] = angles;
    let angle = |k: u32| from + (to - from) * f64::from(k) / f64::from(count);
    let at = |k| {
        let (sin, cos) = angle(k).sin_cos();
        [radius * sin, radius * cos]
    };
    revolved(&Vec::from_iter((0..=count).map(at)), 4 * count)
}

/// A wheel on its axle and a ball in its socket: the closest approach takes at most twenty times the work of the first
/// contact.
#[test]
fn conforming_bodies_take_a_few_times_their_first_contact() {
    let wheel = [
        revolved(&[[5.2, 0.0], [5.2, 8.0]], 192),
        revolved(&[[5.0, -4.0], [5.0, 12.0]], 192),
    ];
    let ball = [
        spherical(5.0, [0.9, 2.6], 12),
        spherical(5.2, [1.2, 2.2], 12),
    ];
    for (bodies, spin) in [(wheel, TAU * DVec3::Z), (ball, DVec3::new(0.5, 0.3, 1.0))] {
        let bodies = bodies.map(|triangles| body(&triangles));
        let turns = Motion::new(Pose::IDENTITY, DVec3::ZERO, spin).unwrap();
        let config = Config::default();
        let problem = Problem::new(
            (&bodies[0], turns),
            (&bodies[1], Motion::STILL),
            1.0,
            &config,
        );
        let problem = problem.unwrap();
        let first = BestFirst::default().solve(&problem, &mut Exhaustive);
        assert!(matches!(first.outcome, Outcome::Free { .. }));
        let closest = approach(&problem);
        assert!(
            matches!(closest.outcome, ClosestApproach::Nearest { .. }),
            "{closest:?}"
        );
        assert!(closest.outcome.upper() - closest.outcome.lower() <= config.tolerance);
        let (most, work) = (20 * first.stats.work(), closest.stats.work());
        assert!(work <= most, "{work} of {most}");
        // A search that ends before knows a part of the distance.
        let config = Config {
            budget: work - work / 8,
            ..config
        };
        let problem = Problem::new(
            (&bodies[0], turns),
            (&bodies[1], Motion::STILL),
            1.0,
            &config,
        );
        let ended = approach(&problem.unwrap()).outcome;
        assert!(
            matches!(ended, ClosestApproach::Unresolved { .. }),
            "{ended:?}"
        );
        let lower = ended.lower();
        assert!(
            lower > 0.02 && lower <= closest.outcome.upper(),
            "{ended:?}"
        );
    }
}
