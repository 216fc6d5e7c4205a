//! Tests distances from obstacles against those of the distance query.

use super::*;
use crate::solver::tests::random_cell;
use ccd_core::order::greater;
use ccd_core::schedule::VectorInstructions;
use ccd_core::vectorize;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::{Body, Pose, Solver};

fn random_points(random: &mut Pcg64) -> [DVec3; 8] {
    std::array::from_fn(|_| {
        let coordinates = [0, 1, 2].map(|_| f64::from(random.random_range(-3.0f32..3.0)));
        DVec3::from_array(coordinates)
    })
}

#[test]
fn distances_are_lower_bounds_and_exact_for_simple_shapes() {
    let mut random = Pcg64::seed_from_u64(21);
    let (mut exact, mut inexact, mut half_spaces) = (0, 0, 0);
    let (mut solver, point_body) = (Solver::new(), Body::sphere(1e-12).unwrap());
    for k in 0..60 {
        let mut cell = random_cell(&mut random);
        if k % 3 == 0 {
            let pose = crate::test_robots::random_pose(&mut random, 1.0);
            cell.add_plane("plane", pose).unwrap();
        }
        let parts = &cell.parts()[cell.robot_part_count()..];
        let obstacles = Obstacles::new(parts, cell.robot_part_count());
        let points = random_points(&mut random);
        let rows = [0, 1, 2].map(|axis| points.map(|point| point[axis] as f32));
        for (part, obstacle) in parts.iter().zip(&obstacles.all) {
            let level = VectorInstructions::Best.simd_level();
            let distances = vectorize!(level, level => {
                let mut row = [0.0; 8];
                let points = Vec3x8::load(level, &rows);
                obstacle.distances(level, points).store_slice(&mut row);
                row
            });
            let reach = 6.0;
            let placed = &cell.bodies()[part.owner];
            for (lane, point) in points.iter().enumerate() {
                let point = (&point_body, Pose::at(point.to_array()).unwrap());
                let outcome = solver
                    .distance(point, (&*placed.body, placed.pose))
                    .unwrap()
                    .outcome;
                let (found, error) = (f64::from(distances[lane]), obstacle.error(reach) + 1e-9);
                // Inside a plane, its distance is negative.
                assert!(found <= outcome.upper() + error, "{found} {outcome:?}");
                if obstacle.is_exact && part.plane.is_none() {
                    assert!(
                        greater(found, 0.0) >= outcome.lower() - error,
                        "{found} {outcome:?}"
                    );
                    exact += 1;
                } else if part.plane.is_some() {
                    half_spaces += 1;
                } else {
                    inexact += 1;
                }
            }
        }
        near_obstacles_are_found(&obstacles, &points, &mut random);
    }
    assert!(
        exact > 300 && inexact > 300 && half_spaces > 50,
        "{exact} {inexact} {half_spaces}"
    );
}

/// Compares the obstacles near a point with their distances one by one.
fn near_obstacles_are_found(obstacles: &Obstacles, points: &[DVec3; 8], random: &mut Pcg64) {
    let level = VectorInstructions::Best.simd_level();
    let distance = random.random_range(0.0..2.0);
    let point = points[0].as_vec3();
    let (near, distances) = vectorize!(level, level => {
        let mut near = Vec::new();
        obstacles.for_each_near(level, (point, 6.0), distance, |obstacle| near.push(obstacle));
        let own = |obstacle: &Obstacle| obstacle.distances(level, Vec3x8::splat(level, point))[0];
        (near, obstacles.all.iter().map(own).collect::<Vec<f32>>())
    });
    for (index, own) in (0..).zip(distances) {
        assert!(near.contains(&index) || f64::from(own) > distance);
    }
}

/// A thin sheared box is not taken for a box.
#[test]
fn a_sheared_box_is_not_exact() {
    let corner = |k: u32| {
        let sign = |bit: u32| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        DVec3::new(sign(0) + 0.8 * sign(2), sign(1), 1e-4 * sign(2))
    };
    let corners: Vec<DVec3> = (0..8).map(corner).collect();
    let polytope = ccd_core::Polytope {
        points: corners,
        ..ccd_core::Polytope::default()
    };
    let cell = crate::test_robots::cell_of_body(Body::polytope(polytope).unwrap());
    assert!(!Obstacle::new(&cell.parts()[0], 0).is_exact);
    let cell = crate::test_robots::cell_of_body(Body::cuboid([1.0, 2.0, 1e-4]).unwrap());
    assert!(Obstacle::new(&cell.parts()[0], 0).is_exact);
}
