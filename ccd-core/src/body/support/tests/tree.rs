//! Tests that the tree search finds points as far as a scan does, for points of many arrangements.

use super::directions_with_ties;
use crate::body::support::{SupportMap, SupportTree};
use crate::rounding::HEIGHT_ERROR_F64;
use crate::tests::scene::{
    Pcg64, RngExt, random_direction, random_point_in_ball, random_power_of_ten, rng,
};
use glam::DVec3;

/// Returns random points of one of seven kinds: on a sphere, in a ball, a plane, a line, one place, a grid or a needle.
fn random_point_cloud(rng: &mut Pcg64, kind: usize, count: usize) -> Vec<DVec3> {
    let [u, v] = [random_direction(rng), random_direction(rng)];
    let whole = |rng: &mut Pcg64| f64::from(rng.random_range(-3..=3));
    let place = |rng: &mut Pcg64| match kind {
        0 => random_direction(rng),
        1 => random_point_in_ball(rng, 1.0),
        2 => u * rng.random_range(-1.0..1.0) + v * rng.random_range(-1.0..1.0),
        3 => u * rng.random_range(-1.0..1.0),
        4 => DVec3::ZERO,
        5 => DVec3::from_array([(); 3].map(|()| whole(rng))),
        _ => u * rng.random_range(-1.0..1.0) + random_point_in_ball(rng, 1e-7),
    };
    (0..count).map(|_| place(rng)).collect()
}

#[test]
fn searching_agrees_with_a_scan() {
    let mut rng = rng(21);
    let counts = [
        1, 2, 7, 8, 9, 63, 64, 65, 100, 511, 513, 1_000, 4_097, 5_000,
    ];
    for (number, count) in counts.into_iter().cycle().take(140).enumerate() {
        // The clouds have all sizes, at up to a million times their size from the origin.
        let size = random_power_of_ten(&mut rng, -30.0, 11.0);
        let offset = random_direction(&mut rng) * size * random_power_of_ten(&mut rng, -3.0, 6.0);
        let offset = if number % 3 == 0 { DVec3::ZERO } else { offset };
        let points: Vec<DVec3> = random_point_cloud(&mut rng, number % 7, count)
            .into_iter()
            .map(|p| p * size + offset)
            .collect();
        let tree = SupportTree::new(&points);
        let reach = points.iter().map(|p| p.abs().max_element());
        let reach = reach.fold(0.0, crate::math::order::greater);
        let (middle, radius) = tree.bounding_ball;
        for p in &points {
            assert!(
                p.distance(middle) <= radius * (1.0 + 16.0 * crate::rounding::UNIT_ROUNDOFF_F64)
            );
        }
        for look in directions_with_ties(200) {
            let height = |p: &DVec3| look.dot(*p);
            let highest = points.iter().map(height);
            let highest = highest.fold(f64::NEG_INFINITY, crate::math::order::greater);
            let found = height(&points[tree.extremal_point(look) as usize]);
            // The slack is the tree's own rounding, and that of the heights here.
            let slack = 4.0 * HEIGHT_ERROR_F64 * reach * look.abs().element_sum();
            assert!(found >= highest - slack, "{count}: {:e}", highest - found);
        }
    }
}

/// Tests that a search visits fewer than 40 nodes on average, for 32768 points on a sphere.
#[test]
fn few_points_of_a_curved_surface_are_visited() {
    let mut rng = rng(22);
    let points = random_point_cloud(&mut rng, 0, 32_768);
    let tree = SupportTree::new(&points);
    let directions = (0..200).map(|_| random_direction(&mut rng));
    let seen: usize = directions.map(|look| tree.count_visited_nodes(look)).sum();
    assert!(seen < 200 * 40, "{} nodes a search", seen / 200);
}

#[test]
fn invalid_directions_give_some_point() {
    let mut rng = rng(23);
    let points = random_point_cloud(&mut rng, 1, 300);
    let support = SupportMap::from_points(&points);
    for look in [DVec3::NAN, DVec3::INFINITY, DVec3::ZERO, -DVec3::INFINITY] {
        assert!(support.extremal_point(look) < 300);
    }
}

/// Tests that the farthest of evenly spaced points is found, also at sizes below the range of f32.
#[test]
fn the_finest_points_are_all_looked_at() {
    for size in [1e-320, 1e-300, 1e-60, 1e12] {
        let points: Vec<DVec3> = (0..100)
            .map(|k| DVec3::new(size * f64::from(k), 0.0, 0.0))
            .collect();
        let tree = SupportTree::new(&points);
        assert_eq!(tree.extremal_point(DVec3::X), 99, "{size:e}");
        assert_eq!(tree.extremal_point(-DVec3::X), 0, "{size:e}");
    }
}
