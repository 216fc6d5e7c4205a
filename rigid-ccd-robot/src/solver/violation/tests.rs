//! Tests the search for a ball inside a convex set against heights along random directions.

use super::contains_ball;
use crate::test_robots::random_vector;
use ccd_core::order::lesser;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::glam::DVec3;

fn lowest_point(points: &[DVec3], direction: DVec3) -> DVec3 {
    let lower = |a: DVec3, b: DVec3| {
        if a.dot(direction) <= b.dot(direction) {
            a
        } else {
            b
        }
    };
    points.iter().copied().reduce(lower).unwrap()
}

/// Tests random sets of points around the origin: the hull contains every ball that is found, and balls are found
/// unless they are nearly the largest possible.
#[test]
fn a_ball_is_found_only_in_the_hull() {
    let mut random = Pcg64::seed_from_u64(31);
    let (mut found, mut missed) = (0, 0);
    for _ in 0..2000 {
        let center = random_vector(&mut random, 0.6);
        let points: Vec<DVec3> = (0..random.random_range(4..30))
            .map(|_| center + random_vector(&mut random, 1.0))
            .collect();
        let radius = random.random_range(0.0..0.5);
        let is_found = contains_ball(|direction| lowest_point(&points, direction), radius);
        let mut depth = f64::INFINITY;
        for _ in 0..500 {
            let direction = random_vector(&mut random, 1.0).normalize();
            depth = lesser(depth, -lowest_point(&points, direction).dot(direction));
        }
        if is_found {
            found += 1;
            assert!(radius <= depth, "{radius} in {points:?}");
        }
        // Sampled directions overestimate the depth slightly.
        missed += usize::from(!is_found && radius < 0.8 * depth);
    }
    assert!(found > 300 && 20 * missed < found, "{found} {missed}");
}

/// Tests sets without a volume, and points that are NaN.
#[test]
fn a_flat_set_contains_no_ball() {
    let flat = [[1.0, 0.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0]].map(DVec3::from);
    assert!(!contains_ball(
        |direction| lowest_point(&flat, direction),
        0.0
    ));
    assert!(!contains_ball(|_| DVec3::NAN, 0.0));
    assert!(!contains_ball(|_| DVec3::ONE, 0.0));
}
