//! Tests principal axes by the definition of an eigenvector.

use super::{principal_axes, sin_cos_of_half_angle};
use crate::tests::scene::{RngExt, random_direction, rng};
use glam::{DVec3, dvec3};

#[test]
fn half_an_angle_is_that_of_the_library() {
    let mut rng = rng(3);
    let special = [0.0, -0.0, 1.0, -1.0, 1e-120, -1e-300, 1e150, 1e-17];
    let pairs = special.iter().flat_map(|&y| special.map(|x| (y, x)));
    let random = (0..10_000).map(|_| (rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0)));
    for (y, x) in pairs.chain(random).filter(|&(y, _)| y != 0.0) {
        let (s, c) = sin_cos_of_half_angle(y, x);
        let (sine, cosine) = (0.5 * f64::atan2(y, x)).sin_cos();
        let off = (s - sine).abs() + (c - cosine).abs();
        assert!(off < 1e-14, "{y:e} {x:e}: {s} {c} for {sine} {cosine}");
    }
}

#[test]
fn axes_are_orthonormal_and_diagonalise_the_spread() {
    let mut rng = rng(4);
    for size in [1e-6, 1.0, 1e9] {
        let stretch = size * dvec3(1.0, 0.2, 0.01);
        let frame = glam::DMat3::from_quat(glam::DQuat::from_axis_angle(
            random_direction(&mut rng),
            1.0,
        ));
        let points: Vec<DVec3> = (0..500)
            .map(|_| frame * (stretch * random_direction(&mut rng)) + stretch)
            .collect();
        let axes = principal_axes(|| points.iter().map(|&p| (p, 1.0)));
        let off = axes.transpose() * axes - glam::DMat3::IDENTITY;
        assert!(off.to_cols_array().iter().all(|x| x.abs() < 1e-14));
        let mean = points.iter().sum::<DVec3>() / 500.0;
        let spread = |i: usize, j: usize| {
            let along = |p: &DVec3| (*p - mean).dot(axes.col(i)) * (*p - mean).dot(axes.col(j));
            points.iter().map(along).sum::<f64>() / (500.0 * size * size)
        };
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            assert!(spread(i, j).abs() < 2e-7, "{}", spread(i, j));
        }
    }
}
