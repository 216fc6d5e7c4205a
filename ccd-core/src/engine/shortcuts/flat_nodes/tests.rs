//! Compares free times of flat nodes with distances at sampled times.

mod worst;

use super::*;
use crate::math::order::lesser;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::settings::Settings;
use crate::tests::nearest::Triangle;
use crate::tests::scene::{
    Pcg64, RngExt, body, distance, random_point_in_ball, random_power_of_ten, random_rotation, rng,
};

/// Draws triangles in one plane, up to the rounding of their coordinates.
fn plate(rng: &mut Pcg64, frame: glam::DQuat) -> Vec<Triangle> {
    let count = rng.random_range(2..8);
    let mut corner = || {
        let at = random_point_in_ball(rng, 1.0);
        frame * DVec3::new(at.x, at.y, 0.0)
    };
    (0..count).map(|_| [corner(), corner(), corner()]).collect()
}

#[test]
fn flat_nodes_stay_apart_for_their_free_time() {
    let mut rng = rng(1);
    let (mut proven, mut close) = (0, 0);
    for number in 0..2_000 {
        let own = [random_rotation(&mut rng), random_rotation(&mut rng)];
        let bodies = own.map(|own| body(&plate(&mut rng, own)));
        let height = random_power_of_ten(&mut rng, -9.0, 0.0);
        let tilt = [0.0, 1e-6][rng.random_range(0..2)];
        let tilt = glam::DQuat::from_rotation_x(tilt) * own[0].inverse();
        let spin =
            [DVec3::ZERO, DVec3::Z, random_point_in_ball(&mut rng, 1.0)][rng.random_range(0..3)];
        let velocity =
            -height * rng.random_range(-1.0..4.0) * DVec3::Z + [0.0, 0.1][number % 2] * DVec3::X;
        let falling = Pose::new(height * DVec3::Z, tilt).unwrap();
        let lying = Pose::new(DVec3::ZERO, own[1].inverse()).unwrap();
        let config = Settings {
            tolerance: 1e-9,
            ..Settings::DEFAULT
        };
        let falling = (&bodies[0], Motion::new(falling, velocity, spin).unwrap());
        let lying = (&bodies[1], Motion::still(lying));
        let problem = Problem::of_moving_bodies(falling, lying, 1.0, &config).unwrap();
        let free = free_time(&problem, [0, 0], 0.0);
        if free > 0.0 {
            proven += 1;
            close += usize::from(height < 1e-6);
        }
        for k in 0..=20 {
            let s = lesser(1.0, free) * f64::from(k) / 20.0;
            let least = distance(&problem, s);
            assert!(
                free == 0.0 || least > problem.kept_gap(),
                "{number}: {least:e} at {s}"
            );
        }
    }
    // Most of the near pairs are proven in f64 only.
    assert!(proven > 800 && close > 200, "{proven} {close}");
}
