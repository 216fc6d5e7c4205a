//! Distances of two convex polytopes that approach and turn a little from call to call: from where the
//! last call ended against from nothing, for every backend, over the size of the pieces.
//!
//! `cargo bench -p ccd-bench --bench oracles`

mod ball;

use ball::{ball, direction};
use ccd_core::glam::DQuat;
use ccd_core::{DistanceOracle, Frame, HullTree, PiecePair, Pose};
use ccd_distance_gjk::{Gjk, GjkF32};
use ccd_distance_vmarch::Vmarch;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::hint::black_box;

/// How many poses a sequence has.
const POSES: usize = 256;

/// Where a call starts from.
#[derive(Clone, Copy)]
enum Start {
    /// From what the call for the pose before left behind.
    Warm,
    /// From nothing.
    Cold,
}

/// Two pieces and the poses they go through.
struct Course {
    a: HullTree,
    b: HullTree,
    poses: Vec<Frame>,
}

fn oracles(criterion: &mut Criterion) {
    let mut rng = Pcg64::seed_from_u64(7);
    for corners in [8, 20, 50, 100, 300, 1000] {
        let course = Course {
            a: ball(&mut rng, corners),
            b: ball(&mut rng, corners),
            poses: poses(&mut rng),
        };
        agrees(&course);
        for (name, start) in [("warm", Start::Warm), ("cold", Start::Cold)] {
            let mut group = criterion.benchmark_group(name);
            group.throughput(Throughput::Elements(POSES as u64));
            let id = |oracle| BenchmarkId::new(oracle, corners);
            group.bench_function(id("vmarch"), |b| b.iter(|| run::<Vmarch>(&course, start)));
            group.bench_function(id("gjk"), |b| b.iter(|| run::<Gjk>(&course, start)));
            group.bench_function(id("gjk-f32"), |b| b.iter(|| run::<GjkF32>(&course, start)));
            group.finish();
        }
    }
}

/// The distances of a whole sequence, added up.
fn run<O: DistanceOracle + Default>(course: &Course, start: Start) -> f64 {
    let mut oracle = O::default();
    let mut cache = O::Cache::default();
    let mut sum = 0.0;
    for pose in &course.poses {
        if let Start::Cold = start {
            cache = O::Cache::default();
        }
        let claim = oracle.separation(black_box(&course.pair(*pose)), &mut cache);
        sum += claim.map_or(0.0, |claim| claim.axis.x);
    }
    sum
}

impl Course {
    fn pair(&self, b_to_a: Frame) -> PiecePair<'_> {
        PiecePair {
            a: self.a.hulls().get(0),
            b: self.b.hulls().get(0),
            b_to_a,
        }
    }

    /// How far apart an oracle says they are in each pose.
    fn distances<O: DistanceOracle + Default>(&self) -> Vec<f64> {
        let (mut oracle, mut cache) = (O::default(), O::Cache::default());
        let distance = |&pose: &Frame| {
            let pair = self.pair(pose);
            let claim = oracle.separation(&pair, &mut cache).expect("no give-up");
            let on_a = claim.a.of(pair.a.points).expect("a point of A");
            let on_b = claim.b.of(pair.b.points).expect("a point of B");
            on_a.distance(pose.point(on_b))
        };
        self.poses.iter().map(distance).collect()
    }
}

/// Nothing is timed that is wrong.
fn agrees(course: &Course) {
    let (one, other) = (course.distances::<Vmarch>(), course.distances::<Gjk>());
    for (vmarch, gjk) in one.iter().zip(&other) {
        assert!((vmarch - gjk).abs() <= 1e-12, "{vmarch} and {gjk}");
    }
}

/// From two radii of clearance to none, a hundredth of a radian from pose to pose.
fn poses(rng: &mut Pcg64) -> Vec<Frame> {
    let (way, turn) = (direction(rng), 0.01 * direction(rng));
    let pose = |k: usize| {
        let done = k as f64 / POSES as f64;
        let rotation = DQuat::from_scaled_axis(k as f64 * turn);
        let pose = Pose::new((4.0 - 1.99 * done) * way, rotation);
        pose.expect("a rotation").into()
    };
    (0..POSES).map(pose).collect()
}

criterion_group!(benches, oracles);
criterion_main!(benches);
