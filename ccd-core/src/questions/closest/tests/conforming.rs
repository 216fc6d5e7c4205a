//! Tests the work of the closest approach of bodies whose surfaces stay close to each other while one body turns.

use super::*;
use crate::engine::answer::EngineSchedule;
use crate::motion::pose::Pose;
use crate::settings::Settings;
use crate::tests::nearest::Triangle;
use crate::tests::scene::body;
use glam::DVec3;
use std::f64::consts::TAU;

/// Returns the triangles of a surface of revolution about z, with a ring of corners at each radius and height.
fn surface_of_revolution(outline: &[[f64; 2]], count: u32) -> Vec<Triangle> {
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

/// Tests that the closest approach of a wheel on its axle takes at most twenty times the work of the first contact.
#[test]
fn a_wheel_on_its_axle_takes_a_few_times_its_first_contact() {
    let wheel = body(&surface_of_revolution(&[[5.2, 0.0], [5.2, 8.0]], 192));
    let axle = body(&surface_of_revolution(&[[5.0, -4.0], [5.0, 12.0]], 192));
    let turns = Motion::new(Pose::IDENTITY, DVec3::ZERO, TAU * DVec3::Z).unwrap();
    let config = Settings::DEFAULT;
    let problem =
        Problem::of_moving_bodies((&wheel, turns), (&axle, Motion::STILL), 1.0, &config).unwrap();
    let first = BestFirst::default().answer_first_contact(&problem, &mut ExhaustiveOracle);
    assert!(matches!(first.outcome, Outcome::Free { .. }));
    let closest = closest_approach_answer(&problem);
    assert!(
        matches!(closest.outcome, Outcome::LeastDistance { .. }),
        "{closest:?}"
    );
    assert!(closest.outcome.upper() - closest.outcome.lower() <= config.tolerance);
    let (most, work) = (
        20 * first.stats.budgeted_work(),
        closest.stats.budgeted_work(),
    );
    assert!(work <= most, "{work} of {most}");
}
