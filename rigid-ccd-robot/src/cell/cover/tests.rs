//! Tests covers against random points of the parts, and inner balls against the parts' support in random directions.

use super::*;
use crate::solver::tests::random_cell;
use ccd_core::order::greater;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

fn random_direction(random: &mut Pcg64) -> DVec3 {
    loop {
        let point = DVec3::from_array([0, 1, 2].map(|_| random.random_range(-1.0..1.0)));
        if (1e-6..1.0).contains(&point.length_squared()) {
            return point.normalize();
        }
    }
}

/// Returns a random point of the hull of some corners: of an edge or a triangle between corners, or inside.
fn random_point(random: &mut Pcg64, corners: &[DVec3]) -> DVec3 {
    let count = random.random_range(1..=4);
    let weights: Vec<f64> = (0..count).map(|_| random.random_range(0.0..1.0)).collect();
    let sum: f64 = weights.iter().sum();
    let corner = |random: &mut Pcg64| corners[random.random_range(0..corners.len())];
    weights
        .iter()
        .map(|weight| corner(random) * (weight / sum))
        .sum()
}

#[test]
fn covers_contain_the_parts_and_inner_balls_are_inside() {
    let mut random = Pcg64::seed_from_u64(11);
    let (mut cut_parts, mut inner_balls, mut loosest) = (0, 0, 0.0);
    for _ in 0..40 {
        let cell = random_cell(&mut random);
        let parts = &cell.parts()[..cell.robot_part_count()];
        let covers = Covers::of_parts(parts);
        assert_eq!(covers.enclosing_balls.len(), parts.len());
        for (index, part) in parts.iter().enumerate() {
            let range = covers.first_ball_by_part[index]..covers.first_ball_by_part[index + 1];
            let balls = &covers.balls[range];
            cut_parts += usize::from(balls.len() > 1);
            for _ in 0..300 {
                let point = random_point(&mut random, part.points());
                let within =
                    |ball: &CoverBall| point.distance(ball.center) + part.radius <= ball.radius;
                assert!(balls.iter().any(within), "{point} of {balls:?}");
                assert!(within(&covers.enclosing_balls[index]));
            }
            for ball in balls.iter().filter(|ball| ball.inner_radius > 0.0) {
                inner_balls += 1;
                for _ in 0..300 {
                    let direction = random_direction(&mut random);
                    let heights = part.points().iter().map(|point| direction.dot(*point));
                    let support = heights.fold(f64::NEG_INFINITY, greater) + part.radius;
                    let height = direction.dot(ball.center) + ball.inner_radius;
                    assert!(height <= support, "{height} {support}");
                    loosest = greater(loosest, ball.inner_radius / ball.radius);
                }
            }
        }
    }
    assert!(cut_parts > 40, "{cut_parts}");
    assert!(inner_balls > 100, "{inner_balls}");
    assert!(loosest > 0.5, "{loosest}");
}

/// A long thin box gets balls along its length, each about as wide as the box.
#[test]
fn a_long_part_is_cut_along_its_length() {
    let cell = crate::test_robots::cell_of_body(rigid_ccd::Body::cuboid([1.0, 0.1, 0.1]).unwrap());
    let parts = &cell.parts()[..1];
    let covers = Covers::of_parts(parts);
    assert_eq!(covers.balls.len(), 2);
    let half = 0.5 * (0.5f64.powi(2) + 2.0 * 0.1f64.powi(2)).sqrt();
    for ball in &covers.balls {
        assert!(ball.radius < 0.62 && ball.radius > half, "{ball:?}");
        assert!((ball.inner_radius - 0.1).abs() < 1e-3, "{ball:?}");
    }
}
