//! Compares the times in closed form with those for which the points are followed.

use super::*;
use crate::math::order::lesser;
use crate::tests::scene::{RngExt, SceneKind, random_direction, random_power_of_ten, rng, scene};

#[test]
fn times_are_proven_and_hardly_shorter_than_those_of_points_that_are_followed() {
    let mut rng = rng(31);
    let (mut all, mut found, mut close) = (0, 0, 0);
    for number in 0..30_000 {
        let kind = SceneKind::passing(number);
        let scene = scene(&mut rng, kind, 2).with_occasional_accelerations(&mut rng);
        let problem = scene.problem();
        let clock = scene.clock * rng.random_range(0.0..1.0);
        let placed = PlacedPair::new(&problem, [0, 0], clock);
        let normal = random_direction(&mut rng);
        let plane = SeparatingPlane {
            normal,
            gap_excess: random_power_of_ten(&mut rng, -9.0, 0.0),
        };
        all += 1;
        let Some(free) = placed.free_time_at_present_rate(&plane) else {
            continue;
        };
        let followed = placed
            .fixed_plane_free_time(normal, plane.gap_excess)
            .bounded();
        let left = 1.0 - clock;
        let longest = followed.unwrap_or(f64::INFINITY);
        let free = free.bounded().unwrap_or(f64::INFINITY);
        assert!(free > 0.0, "{number}");
        // The points are followed up to the last percent.
        assert!(
            lesser(free, left) <= longest * (1.0 + 1.0 / 32.0),
            "{number}: {free:e} beyond {longest:e}"
        );
        found += 1;
        close += usize::from(free >= 0.7 * lesser(longest, left));
    }
    assert!(4 * found > all && found < all, "{found} of {all}");
    assert!(10 * close > 9 * found, "{close} of {found}");
}
