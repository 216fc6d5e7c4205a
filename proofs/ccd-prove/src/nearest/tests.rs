use super::*;

#[test]
fn the_nearest_points_of_triangles_segments_and_points_are_found() {
    let [x, y] = [DVec3::X, DVec3::Y];
    for (corners, point, expected) in [
        (
            [DVec3::ZERO, x, y],
            DVec3::new(0.2, 0.3, 5.0),
            [0.5, 0.2, 0.3],
        ),
        (
            [DVec3::ZERO, x, y],
            DVec3::new(0.5, -2.0, 1.0),
            [0.5, 0.5, 0.0],
        ),
        (
            [DVec3::ZERO, x, y],
            DVec3::new(3.0, -1.0, 0.0),
            [0.0, 1.0, 0.0],
        ),
        ([-x, x, x], DVec3::new(0.0, 2.0, 0.0), [0.5, 0.5, 0.0]),
        ([x, x, -x], DVec3::new(-3.0, 2.0, 0.0), [0.0, 0.0, 1.0]),
    ] {
        let weights = nearest_weights(corners, point);
        let error = (0..3)
            .map(|k| (weights[k] - expected[k]).abs())
            .sum::<f64>();
        assert!(error < 1e-12, "{corners:?} {point}: {weights:?}");
    }
    let weights = nearest_weights([x; 3], y);
    assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
}
