//! Tests distances of surfaces against a scan of all pairs of triangles, and distances of triangles against a grid of
//! points.

use super::super::triangle::{nearest_or_common_points, nearest_points};
use super::super::{Surface, TruthSolver};
use super::{query, random_motion, random_vector, triangle_soup};
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

#[test]
fn the_tree_finds_the_nearest_of_all_pairs() {
    let mut rng = Pcg64::seed_from_u64(5);
    let (mut apart, mut common) = (0, 0);
    for _ in 0..200 {
        let meshes = [triangle_soup(&mut rng, 12), triangle_soup(&mut rng, 7)];
        let surfaces = meshes.each_ref().map(Surface::new);
        let from = random_vector(&mut rng, 3.0);
        let motions = [from, DVec3::ZERO].map(|from| random_motion(&mut rng, from, -from, 3.0));
        let query = query(motions[0], motions[1], 1.0);
        let time = rng.random_range(0.0..1.0);
        let placed = [0, 1].map(|body| {
            let pose = motions[body].pose(time);
            let corner = |&i: &u32| pose.transform_point(meshes[body].vertices()[i as usize]);
            let faces = meshes[body].faces().iter();
            faces
                .map(|face| face.each_ref().map(corner))
                .collect::<Vec<_>>()
        });
        let [a, b] = &placed;
        let pairs = a
            .iter()
            .flat_map(|a| b.iter().map(move |b| nearest_or_common_points(a, b)));
        let expected = pairs
            .map(|(p, q)| (p - q).length())
            .fold(f64::INFINITY, lesser);
        let found = TruthSolver::new(&surfaces[0], &surfaces[1]).distance_bounds(&query, time);
        let off = 1e-13;
        assert!(
            found.distance_lower_bound <= expected + off && expected - off <= found.upper_distance,
            "{found:?} {expected}"
        );
        assert!(
            0.0 <= found.distance_lower_bound
                && found.upper_distance - found.distance_lower_bound < 1e-12,
            "{found:?}"
        );
        if expected > 1e-9 {
            apart += 1;
        } else {
            common += 1;
        }
    }
    assert!(apart > 80 && common > 20, "{apart} {common}");
}

#[test]
fn nearest_points_are_as_near_as_a_grid_finds() {
    const STEPS_PER_EDGE: u32 = 24;
    let mut rng = Pcg64::seed_from_u64(6);
    for round in 0..150 {
        let [mut a, b] = [0, 1].map(|_| [0, 1, 2].map(|_| random_vector(&mut rng, 1.0)));
        match round % 4 {
            0 => a[2] = a[0],
            1 => a[2] = a[0].lerp(a[1], 0.3),
            2 => a = a.map(|p| p + 3.0 * random_unit_vector(&mut rng)),
            _ => {}
        }
        let (p, q) = nearest_or_common_points(&a, &b);
        let found = (p - q).length();
        let grid = grid_points_in_triangle(&a, STEPS_PER_EDGE).flat_map(|p| {
            grid_points_in_triangle(&b, STEPS_PER_EDGE).map(move |q| (p - q).length())
        });
        let least = grid.fold(f64::INFINITY, lesser);
        // Each point has a grid point within an edge divided by the steps.
        let spacing = 2.0 * 2.0 * f64::sqrt(3.0) / f64::from(STEPS_PER_EDGE) * 2.0;
        assert!(
            found <= least + 1e-14 && least - spacing <= found,
            "{found} {least}"
        );
        let edges_and_feet = nearest_points(&a, &b);
        assert!(found <= (edges_and_feet.0 - edges_and_feet.1).length());
    }
}

fn random_unit_vector(rng: &mut impl Rng) -> DVec3 {
    random_vector(rng, 1.0).normalize()
}

fn grid_points_in_triangle([a, b, c]: &[DVec3; 3], steps: u32) -> impl Iterator<Item = DVec3> {
    let fraction = move |k: u32| f64::from(k) / f64::from(steps);
    (0..=steps).flat_map(move |i| {
        (0..=steps - i).map(move |j| a + fraction(i) * (b - a) + fraction(j) * (c - a))
    })
}
