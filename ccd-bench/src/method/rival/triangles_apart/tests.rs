use super::{Triangle, nearest_points};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

fn random_vec(rng: &mut Pcg64) -> DVec3 {
    DVec3::from_array([0; 3].map(|_| rng.random_range(-1.0..1.0)))
}

/// Returns two random triangles: in parallel planes, with corners on a grid, collapsed to segments, or in general
/// position.
fn random_triangle_pair(rng: &mut Pcg64) -> (Triangle, Triangle) {
    let kind = rng.random_range(0..5);
    let mut triangle = |shift: DVec3| {
        let mut corners = [0; 3].map(|_| random_vec(rng));
        match kind {
            0 => corners.iter_mut().for_each(|c| c.z = 0.0),
            1 => corners.iter_mut().for_each(|c| *c = (2.0 * *c).round()),
            2 => corners[2] = corners[0],
            _ => {}
        }
        corners.map(|c| c + shift)
    };
    let a = triangle(DVec3::ZERO);
    let b = triangle(DVec3::ZERO);
    let shift = 1.5 * random_vec(rng);
    let shift = if kind == 1 { shift.round() } else { shift };
    (a, b.map(|corner| corner + shift))
}

/// Returns the least distance of a point from a grid of points on a triangle, which are `1/steps` of an edge apart.
fn distance_to_samples(point: DVec3, [a, b, c]: &Triangle, steps: u32) -> f64 {
    let mut least = f64::INFINITY;
    for i in 0..=steps {
        for j in 0..=steps - i {
            let (u, v) = (
                f64::from(i) / f64::from(steps),
                f64::from(j) / f64::from(steps),
            );
            least = lesser(least, point.distance(*a + u * (*b - *a) + v * (*c - *a)));
        }
    }
    least
}

#[test]
fn the_points_are_nearest() {
    let mut rng = Pcg64::seed_from_u64(2);
    let (mut apart, mut meeting) = (0, 0);
    for _ in 0..50_000 {
        let (a, b) = random_triangle_pair(&mut rng);
        let found = nearest_points(&a, &b);
        let distance = found.vector_from_a_to_b().length();
        for (point, triangle) in [(found.point_on_a, &a), (found.on_b, &b)] {
            let off = nearest_points(&[point; 3], triangle)
                .vector_from_a_to_b()
                .length();
            assert!(off < 1e-9, "{off} off: {a:?} {b:?}");
        }
        if distance > 1e-6 {
            // No plane could separate them by more than their distance, so this proves the distance.
            let n = found.vector_from_a_to_b() / distance;
            let low = b.map(|p| n.dot(p)).into_iter().fold(f64::INFINITY, lesser);
            let high = a
                .map(|p| n.dot(p))
                .into_iter()
                .fold(f64::NEG_INFINITY, greater);
            assert!(
                low - high > distance - 1e-9,
                "{distance} {} {a:?} {b:?}",
                low - high
            );
            apart += 1;
        } else {
            meeting += 1;
        }
    }
    assert!(
        apart > 25_000 && meeting > 2_000,
        "{apart} apart, {meeting} meeting"
    );
}

#[test]
fn samples_agree() {
    const GRID_STEPS: u32 = 24;
    let mut rng = Pcg64::seed_from_u64(3);
    for _ in 0..100 {
        let (a, b) = random_triangle_pair(&mut rng);
        let distance = nearest_points(&a, &b).vector_from_a_to_b().length();
        let mut least = f64::INFINITY;
        let [p, q, r] = a;
        for i in 0..=GRID_STEPS {
            for j in 0..=GRID_STEPS - i {
                let (u, v) = (
                    f64::from(i) / f64::from(GRID_STEPS),
                    f64::from(j) / f64::from(GRID_STEPS),
                );
                least = lesser(
                    least,
                    distance_to_samples(p + u * (q - p) + v * (r - p), &b, GRID_STEPS),
                );
            }
        }
        // Edges are at most √12 long, and some sample is within an edge's step of either point.
        let spacing = 2.0 * 12_f64.sqrt() / f64::from(GRID_STEPS);
        assert!(distance <= least + 1e-12, "{distance} {least}");
        assert!(least <= distance + spacing, "{distance} {least}");
    }
}

#[test]
fn a_piercing_edge_is_a_meeting() {
    let flat = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let [low, high] = [-1.0, 1.0].map(|z| DVec3::new(0.25, 0.25, z));
    let upright = [low, high, DVec3::new(5.0, 5.0, 0.5)];
    for (a, b) in [(flat, upright), (upright, flat)] {
        let found = nearest_points(&a, &b);
        assert_eq!(found.point_on_a, found.on_b);
        assert!(found.point_on_a.z.abs() < 1e-15);
    }
}
