use super::*;

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
