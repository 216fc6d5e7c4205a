use super::*;
use glam::dvec3;

/// Returns a generator of pseudo-random numbers in −1..1, by a linear congruence.
fn number_generator() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Tests that the visited points are those that a scan of all points finds in front of the plane, or next to it.
#[test]
fn nothing_in_front_is_passed_over() {
    let mut next = number_generator();
    let mut point = || dvec3(next(), next(), next());
    for count in [0, 1, 8, 9, 100, 1000] {
        let points: Vec<DVec3> = (0..count).map(|_| point()).collect();
        let tree = PointTree::new(&points);
        for _ in 0..50 {
            let plane = [point(), point(), point()];
            let normal = (plane[1] - plane[0]).cross(plane[2] - plane[0]);
            let mut found = Vec::new();
            tree.for_each_not_behind(plane, |k| found.push(k));
            found.sort_unstable();
            let front = |&k: &u32| normal.dot(points[k as usize] - plane[0]) > -1e-12;
            let expected: Vec<u32> = (0..count).filter(front).collect();
            assert_eq!(found, expected);
        }
    }
}

/// Tests that only the last point of a long row is visited for a plane through that point.
#[test]
fn most_points_are_passed_over_together() {
    let points: Vec<DVec3> = (0..100_000)
        .map(|k| dvec3(f64::from(k), 0.0, 0.0))
        .collect();
    let tree = PointTree::new(&points);
    let mut found = Vec::new();
    tree.for_each_not_behind(
        [
            dvec3(99_999.0, 0.0, 0.0),
            dvec3(99_999.0, 1.0, 0.0),
            dvec3(99_999.0, 0.0, 1.0),
        ],
        |k| found.push(k),
    );
    assert_eq!(found, [99_999]);
    assert!(tree.nodes.len() < 32_768);
}
