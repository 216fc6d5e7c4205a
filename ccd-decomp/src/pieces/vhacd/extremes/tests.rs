use super::*;
use crate::hull::hull;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// Tests that the hulls with and without inner points have the same corners, for points on a grid, in a ball and on a
/// sphere.
#[test]
fn removed_points_are_no_corners() {
    let point = || [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64];
    let given = (prop::collection::vec(point(), 40..400), 0..3_u8);
    let mut runner = TestRunner::deterministic();
    let (mut kept, mut all) = ([0; 3], [0; 3]);
    for _ in 0..90 {
        let (points, kind) = given.new_tree(&mut runner).unwrap().current();
        let place = |&p: &[f64; 3]| match kind {
            0 => (4.0 * DVec3::from_array(p)).round(),
            1 => DVec3::from_array(p),
            _ => DVec3::from_array(p).normalize(),
        };
        let points: Vec<DVec3> = points.iter().map(place).collect();
        let corners = |points: &[DVec3]| {
            let hull = hull(points).unwrap();
            let bits = |&p: &DVec3| (p + DVec3::ZERO).to_array().map(f64::to_bits);
            let mut corners: Vec<[u64; 3]> = hull.points.iter().map(bits).collect();
            corners.sort_unstable();
            corners
        };
        let fewer = remove_inner_points(points.clone());
        assert_eq!(corners(&fewer), corners(&points));
        kept[kind as usize] += fewer.len();
        all[kind as usize] += points.len();
    }
    // Hardly any points of a sphere are inner; most of the others are.
    assert!(
        2 * kept[0] < all[0] && 2 * kept[1] < all[1],
        "{kept:?} of {all:?}"
    );
    assert!(2 * kept[2] > all[2], "{kept:?} of {all:?}");
}

#[test]
fn points_too_fine_or_in_a_plane_are_kept() {
    let plane: Vec<DVec3> = (0..100)
        .map(|k| DVec3::new(f64::from(k % 10), f64::from(k / 10), 0.0))
        .collect();
    assert_eq!(remove_inner_points(plane.clone()), plane);
    let mut fine = grid();
    assert!(remove_inner_points(fine.clone()).len() < 600);
    fine.push(DVec3::splat(1e-95));
    assert_eq!(remove_inner_points(fine.clone()), fine);
}

#[test]
fn the_farthest_points_are_few() {
    let points = grid();
    let far = extreme_points(&points, 96);
    // The corners of a cube.
    assert_eq!(far.len(), 8);
    assert!(extreme_points(&[], 96).is_empty());
}

/// Returns the points of whole coordinates in a cube.
fn grid() -> Vec<DVec3> {
    let point = |k: u32| DVec3::new((k % 10).into(), (k / 10 % 10).into(), (k / 100).into());
    (0..1000).map(point).collect()
}
