//! Compares periods with distances at sampled times, and convergents with known fractions.

use super::*;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::rounding::position_rounding;
use crate::tests::scene::{
    RngExt, random_direction, random_point_in_ball, random_power_of_ten, random_rotation, rng,
};
use glam::DVec3;

#[test]
fn distances_change_by_no_more_than_said() {
    let mut rng = rng(1);
    let (mut exact, mut drifting) = (0, 0);
    for number in 0..2_000 {
        let reach = 2.0;
        let rate = TAU * random_power_of_ten(&mut rng, 0.5, 4.0);
        let ratio = [0.0, 1.0, 3.0 / 7.0, 0.5001, 1e-6][number % 5];
        let velocity = random_point_in_ball(&mut rng, 1.0);
        let drift = random_point_in_ball(&mut rng, 1.0)
            * [0.0, random_power_of_ten(&mut rng, -6.0, 0.0)][number / 5 % 2];
        let pull = random_point_in_ball(&mut rng, 1.0) * [0.0, 1.0][number / 10 % 2];
        let spins = [rate, ratio * rate].map(|rate| rate * random_direction(&mut rng));
        let velocities = [velocity, velocity + drift];
        let mut paths = [0, 1].map(|k| {
            let start = Pose::new(
                random_point_in_ball(&mut rng, 3.0),
                random_rotation(&mut rng),
            )
            .unwrap();
            let center = random_point_in_ball(&mut rng, 3.0);
            let motion = Motion::about(start, velocities[k], spins[k], center).unwrap();
            Path::new(&motion, DVec3::ZERO, 1.0).with_acceleration(pull)
        });
        if number % 3 == 0 {
            paths.swap(0, 1);
        }
        let points = paths.map(|path| path.center + random_point_in_ball(&mut rng, reach));
        let rounding = paths
            .iter()
            .map(|path| position_rounding(reach, path.angular_speed, 10.0))
            .sum::<f64>();
        let distance = |s: f64| {
            let [a, b] = [0, 1].map(|k| paths[k].frame(s).transform_point(points[k]));
            a.distance(b)
        };
        let bodies = [0, 1].map(|k| PathWithRadius {
            path: &paths[k],
            reach,
        });
        let mut before = 0.0;
        for period in Period::periods_up_to_half_duration(bodies) {
            assert!(
                period.length >= before && period.length <= 0.5,
                "{period:?}"
            );
            before = period.length;
            let count = rng.random_range(1.0..1.0 / period.length).floor();
            let s = rng.random_range(0.0..1.0 - count * period.length);
            let changed = (distance(s + count * period.length) - distance(s)).abs();
            let said = count * period.max_distance_change;
            assert!(changed <= said + rounding, "{number} {period:?}: {changed}");
            exact += usize::from(said < 1e-9);
            drifting += usize::from(changed > 0.1 * said && said > 1e-9);
        }
    }
    assert!(exact > 500 && drifting > 100, "{exact} {drifting}");
}

#[test]
fn common_periods_are_the_best_fractions() {
    let fractions = |number: f64, most: f64| -> Vec<[f64; 2]> {
        let all = convergents(number);
        all.take_while(|&[_, below]| below < most).collect()
    };
    assert_eq!(fractions(0.0, 9.0), [[0.0, 1.0]]);
    assert_eq!(fractions(1.0, 9.0), [[1.0, 1.0]]);
    // Rounding may add some fractions, but hides none.
    assert!(fractions(0.375, 9.0).contains(&[3.0, 8.0]));
    assert_eq!(fractions(f64::NAN, 9.0), [[0.0; 2]; 0]);
    let of_pi = [[0.0, 1.0], [1.0, 3.0], [7.0, 22.0], [106.0, 333.0]];
    assert_eq!(fractions(std::f64::consts::FRAC_1_PI, 334.0), of_pi);
}
