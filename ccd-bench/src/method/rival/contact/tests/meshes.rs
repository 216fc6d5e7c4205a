//! Compares answers for torus knots with samples of their screw motions.

use super::super::*;
use crate::method::rival::Placement;
use crate::method::rival::tests::samples::{RandomSource, distance};
use crate::scene::model::Model;
use crate::scene::tests::shots::ShotGenerator;
use ccd_core::Motion;
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;

/// The number of steps between the samples of a motion for the reference answer.
const SAMPLE_INTERVAL_COUNT: u32 = 1000;

fn placement(query: &Motions, time: f64) -> Placement {
    let [a, b] = [query.a, query.b].map(|motion| RivalMotion::new(&motion).placement_at(time));
    a.relative_to(&b)
}

/// Returns the time of the first sample at which the two meshes touch or cross.
fn first_sampled_crossing_time(tree: &ObbTree, query: &Motions) -> Option<f64> {
    let mut stack = Vec::new();
    (0..=SAMPLE_INTERVAL_COUNT)
        .map(|k| query.duration * f64::from(k) / f64::from(SAMPLE_INTERVAL_COUNT))
        .find(|&time| trees_intersect(tree, tree, &placement(query, time), &mut stack))
}

/// Returns the distance of two meshes that do not cross, by all pairs of triangles.
fn mesh_distance(mesh: &TriangleMesh, at: &Placement) -> f64 {
    let triangles = || {
        let corner = |v: u32| mesh.vertices()[v as usize];
        mesh.faces().iter().map(move |face| face.map(corner))
    };
    triangles()
        .map(|t| t.map(|p| at.apply(p)))
        .flat_map(|t| triangles().map(move |u| distance(&t, &u)))
        .fold(f64::INFINITY, lesser)
}

/// Asserts that the method's contacts are neither missed nor late nor farther apart than the tolerance, as samples of
/// the motions show. Returns the number of hits.
fn assert_contacts_fit_samples(queries: &[Motions], tolerance: f64) -> usize {
    let mesh = Model::Knot216.generate().unwrap();
    let tree = ObbTree::new(&mesh);
    let mut contact = Contact::new(&mesh, &mesh);
    let mut hits = 0;
    for query in queries {
        let reply = contact.answer(query, tolerance);
        let moved = to_screw_motions(query).unwrap();
        let crossing = first_sampled_crossing_time(&tree, &moved);
        match reply.claim {
            ContactClaim::Contact { time } => {
                assert!(crossing.is_none_or(|crossing| time <= crossing), "late");
                let gap = mesh_distance(&mesh, &placement(&moved, time));
                assert!(gap <= tolerance, "{gap} at {time}, tolerance {tolerance}");
                hits += 1;
            }
            ContactClaim::NoContact => assert_eq!(crossing, None, "missed"),
            claim => panic!("{claim:?}"),
        }
    }
    hits
}

fn shot_queries(count: usize) -> Vec<Motions> {
    let shots = ShotGenerator {
        count,
        translation_count: count / 3,
        start_distances: 3.0..3.8,
        max_offset: 2.3,
        seed: 7,
    };
    shots.queries().unwrap()
}

#[test]
fn shots_are_answered_never_late_and_within_the_tolerance() {
    let queries = shot_queries(45);
    for (tolerance, part) in [(1e-2, 0..15), (1e-4, 15..30), (1e-8, 30..45)] {
        let hits = assert_contacts_fit_samples(&queries[part], tolerance);
        assert!((4..15).contains(&hits), "{hits} of 15 hit");
    }
}

#[test]
fn both_bodies_may_move_and_turn_far() {
    let mut samples = RandomSource::new(8);
    let queries: Vec<Motions> = shot_queries(20)
        .into_iter()
        .map(|query| {
            let (spin, far) = (samples.vector(1.0), samples.vector(5.0));
            Motions {
                // A displacement along the axis makes the screw another motion.
                a: with_velocities(&query.a, query.a.velocity() + 0.1 * spin, spin),
                b: with_velocities(&query.b, DVec3::ZERO, far),
                ..query
            }
        })
        .collect();
    let hits = assert_contacts_fit_samples(&queries, 1e-4);
    assert!((6..20).contains(&hits), "{hits} of 20 hit");
}

/// Returns a motion from the same start pose with other velocities.
fn with_velocities(motion: &Motion, velocity: DVec3, spin: DVec3) -> Motion {
    Motion::new(motion.start(), velocity, spin).unwrap()
}
