//! Tests the referee's answers for random triangles against a test of all pairs of triangles at many times.

use super::super::{Surface, Truth, TruthSolver};
use super::{query, random_motion, random_vector, triangle_soup};
use ccd_core::Motion;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_decomp::TriangleMesh;
use rand::SeedableRng;
use rand_pcg::Pcg64;

const TIME_STEP_COUNT: u32 = 600;

#[test]
fn brackets_agree_with_all_pairs_at_many_times() {
    let mut rng = Pcg64::seed_from_u64(11);
    let (mut hits, mut free, mut initial) = (0, 0, 0);
    for round in 0..300 {
        let meshes = [
            triangle_soup(&mut rng, 1 + round % 5),
            triangle_soup(&mut rng, 1 + round % 3),
        ];
        // Every eighth case starts where it may be in contact.
        let far = if round % 8 == 0 { 0.6 } else { 2.4 };
        let from = far * random_vector(&mut rng, 1.0).normalize();
        let aim = random_vector(&mut rng, 1.2) - from;
        // Every third case turns a few times.
        let spin = if round % 3 == 0 { 15.0 } else { 2.0 };
        let a = random_motion(&mut rng, from, aim + DVec3::X, spin);
        let b = random_motion(&mut rng, DVec3::ZERO, DVec3::X, spin);
        let surfaces = meshes.each_ref().map(Surface::new);
        let referee = TruthSolver::new(&surfaces[0], &surfaces[1]);
        let query = query(a, b, 1.0);
        let first = (0..=TIME_STEP_COUNT)
            .map(|k| f64::from(k) / f64::from(TIME_STEP_COUNT))
            .find(|&time| meshes_pierce(&meshes, [&a, &b], time));
        let truth = referee.first_contact(&query);
        match (truth, first) {
            (Truth::Hit { lo, hi }, first) => {
                hits += 1;
                assert!(lo < hi && hi - lo < 1e-10, "{round}: {truth:?}");
                assert!(
                    first.is_none_or(|first| hi <= first + 1e-9),
                    "{round}: {truth:?} {first:?}"
                );
                assert!(
                    referee
                        .distance_bounds(&query, greater(0.0, lo - 1e-6))
                        .distance_lower_bound
                        > 0.0,
                    "{round}"
                );
                assert!(
                    referee.distance_bounds(&query, hi).upper_distance < 1e-10,
                    "{round}"
                );
                // Contact is visible shortly afterwards in plain floats.
                assert!((1..40).any(|k| meshes_pierce(
                    &meshes,
                    [&a, &b],
                    hi + 1e-9 * 1.3_f64.powi(k)
                )));
            }
            (Truth::Free, None) => free += 1,
            (Truth::ContactAtStart, Some(0.0)) => initial += 1,
            _ => panic!("{round}: {truth:?}, by samples {first:?}"),
        }
    }
    assert!(
        hits > 100 && free > 60 && initial > 5,
        "{hits} {free} {initial}"
    );
}

/// Returns true if an edge of one mesh passes through a triangle of the other mesh, at the poses that the engine
/// computes.
fn meshes_pierce(meshes: &[TriangleMesh; 2], motions: [&Motion; 2], time: f64) -> bool {
    let placed = [0, 1].map(|body| {
        let pose = motions[body].pose(time);
        let mesh = &meshes[body];
        let corner = |&i: &u32| pose.transform_point(mesh.vertices()[i as usize]);
        let faces = mesh.faces().iter();
        faces
            .map(|face| face.each_ref().map(corner))
            .collect::<Vec<_>>()
    });
    let through = |a: &[DVec3; 3], b: &[DVec3; 3]| {
        (0..3).any(|i| crosses_triangle([a[i], a[(i + 1) % 3]], b))
    };
    let [a, b] = placed;
    a.iter()
        .any(|a| b.iter().any(|b| through(a, b) || through(b, a)))
}

/// Returns true if a segment passes through a triangle: p + s (q − p) = a + β (b − a) + γ (c − a) with all parameters
/// in range.
fn crosses_triangle([p, q]: [DVec3; 2], [a, b, c]: &[DVec3; 3]) -> bool {
    let columns = ccd_core::glam::DMat3::from_cols(p - q, b - a, c - a);
    let fractions = columns.inverse() * (p - a);
    fractions.min_element() >= 0.0 && fractions.x <= 1.0 && fractions.y + fractions.z <= 1.0
}
