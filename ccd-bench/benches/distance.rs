//! Benchmarks the distance computation of two convex pieces with every backend, over several shapes, separations, and
//! rotations between calls.
//!
//! ```sh
//! cargo bench -p ccd-bench --bench distance
//! cargo bench -p ccd-bench --bench distance -- 'ball-20/near'
//! ```

mod ball;
mod settings;

use ball::{random_direction, random_sphere_point_hull};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Body, DistanceOracle, Frame, PiecePair, Pieces, Pose};
use ccd_distance_gjk::{ClosedForm, Gjk};
use ccd_distance_vmarch::Vmarch;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use settings::criterion_settings;
use std::hint::black_box;

/// The number of poses in a sequence.
const POSE_COUNT: usize = 256;

/// Two pieces of one shape, and the sequence of poses at which their distance is computed.
struct PoseSequence {
    a: Pieces,
    b: Pieces,
    poses: Vec<Frame>,
    cache_state: CacheState,
}

/// Whether a distance call starts from the oracle's cache of the call before it.
#[derive(Clone, Copy)]
enum CacheState {
    /// The call starts from the cache that the call for the previous pose has filled.
    Warm,
    /// The call starts from an empty cache.
    Cold,
}

/// The kinds of sequences: a name, the rotation from pose to pose in radians, and the state of the cache.
const SEQUENCE_KINDS: [(&str, f64, CacheState); 3] = [
    ("close", 0.01, CacheState::Warm),
    ("apart", 0.3, CacheState::Warm),
    ("cold", 0.01, CacheState::Cold),
];

/// The separations of the pieces: a name, and the distance of their bounding balls, which have radius 1.
const CLEARANCES: [(&str, f64); 3] = [("near", 1e-3), ("middle", 1.0), ("far", 20.0)];

fn benchmark_distances(criterion: &mut Criterion) {
    let mut rng = Pcg64::seed_from_u64(7);
    for (shape, a, b) in pieces_in_unit_ball(&mut rng) {
        for (separation, clearance) in CLEARANCES {
            for (coherence, turn, start) in SEQUENCE_KINDS {
                let course = PoseSequence {
                    a: a.clone(),
                    b: b.clone(),
                    poses: poses(&mut rng, clearance, turn),
                    cache_state: start,
                };
                let mut group = criterion.benchmark_group(format!("distance/{shape}/{separation}"));
                group.throughput(Throughput::Elements(POSE_COUNT as u64));
                let distances = course.distances::<Gjk>();
                let id = |oracle| BenchmarkId::new(oracle, coherence);
                // The backends must agree before they are timed.
                assert_distances_close(&distances, &course.distances::<Vmarch>());
                group.bench_function(id("vmarch"), |b| b.iter(|| run_sequence::<Vmarch>(&course)));
                group.bench_function(id("gjk"), |b| b.iter(|| run_sequence::<Gjk>(&course)));
                if a.are_all_triangles() {
                    assert_distances_close(&distances, &course.distances::<ClosedForm>());
                    group.bench_function(id("direct"), |b| {
                        b.iter(|| run_sequence::<ClosedForm>(&course));
                    });
                }
                group.finish();
            }
        }
    }
}

/// Returns a pair of pieces for each shape, with the shape's name; every piece lies within the unit ball.
fn pieces_in_unit_ball(rng: &mut Pcg64) -> Vec<(String, Pieces, Pieces)> {
    let side = DVec3::splat(3f64.sqrt().recip());
    let cube = Body::cuboid(side).expect("a box").pieces().clone();
    let slab = DVec3::new(0.7, 0.7, 1e-3);
    let slab = Body::cuboid(slab).expect("a box").pieces().clone();
    let triangle = [
        DVec3::X,
        DVec3::new(-0.5, 0.8, 0.0),
        DVec3::new(-0.5, -0.8, 0.1),
    ];
    let triangle = Pieces::from_triangles(&triangle, &[[0, 1, 2]], &[0]).expect("a triangle");
    let mut shapes = vec![
        ("triangle".to_owned(), triangle.clone(), triangle),
        ("cube".to_owned(), cube.clone(), cube),
        ("slab".to_owned(), slab.clone(), slab),
    ];
    for corners in [20, 100, 1000] {
        let mut hull = || random_sphere_point_hull(rng, corners).hulls().clone();
        shapes.push((format!("ball-{corners}"), hull(), hull()));
    }
    shapes
}

/// Computes the distance at every pose of a sequence, and returns a sum over the results so that the compiler removes
/// no call.
fn run_sequence<O: DistanceOracle + Default>(course: &PoseSequence) -> f64 {
    let mut oracle = O::default();
    let mut cache = O::Cache::default();
    let mut sum = 0.0;
    for pose in &course.poses {
        if let CacheState::Cold = course.cache_state {
            cache = O::Cache::default();
        }
        let claim = oracle.separation(black_box(&course.pair_at_pose(*pose)), &mut cache);
        sum += claim.map_or(0.0, |claim| claim.axis.x);
    }
    sum
}

impl PoseSequence {
    fn pair_at_pose(&self, b_to_a: Frame) -> PiecePair<'_> {
        PiecePair {
            a: self.a.get(0),
            b: self.b.get(0),
            b_to_a,
        }
    }

    /// Returns the distance that an oracle reports for each pose.
    fn distances<O: DistanceOracle + Default>(&self) -> Vec<f64> {
        let (mut oracle, mut cache) = (O::default(), O::Cache::default());
        let distance = |&pose: &Frame| {
            let pair = self.pair_at_pose(pose);
            let claim = oracle.separation(&pair, &mut cache).expect("no give-up");
            let on_a = claim.a.position(pair.a.points).expect("a point of A");
            let on_b = claim.b.position(pair.b.points).expect("a point of B");
            on_a.distance(pose.transform_point(on_b))
        };
        self.poses.iter().map(distance).collect()
    }
}

/// The largest allowed difference between the distances of two backends. It is far above their rounding at the largest
/// distance here.
const DISTANCE_TOLERANCE: f64 = 1e-9;

fn assert_distances_close(one: &[f64], other: &[f64]) {
    for (one, other) in one.iter().zip(other) {
        assert!(
            (one - other).abs() <= DISTANCE_TOLERANCE,
            "{one} and {other}"
        );
    }
}

/// Returns poses of B in A's frame: B rotates by `turn` radians from pose to pose, at a fixed position.
fn poses(rng: &mut Pcg64, clearance: f64, turn: f64) -> Vec<Frame> {
    let (way, turn) = (random_direction(rng), turn * random_direction(rng));
    let pose = |k: usize| {
        let rotation = DQuat::from_scaled_axis(k as f64 * turn);
        let pose = Pose::new((2.0 + clearance) * way, rotation);
        pose.expect("a rotation").into()
    };
    (0..POSE_COUNT).map(pose).collect()
}

criterion_group!(name = benches; config = criterion_settings(10, 100, 300); targets = benchmark_distances);
criterion_main!(benches);
