//! Benchmarks support functions on pieces of several sizes: a scan of all corners, and hill climbing from a cold and
//! from a warm start. The result decides `ccd_core::tuning::MAX_SCANNED_POINTS`.
//!
//! `cargo bench -p ccd-bench --bench support`

mod ball;
mod settings;

use ball::{random_direction, random_sphere_point_hull};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{SupportScan, SupportTable};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use settings::criterion_settings;
use std::hint::black_box;

/// The number of directions for which a benchmark searches the extremal corner.
const DIRECTION_COUNT: usize = 256;

fn benchmark_support_search(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("support");
    group.throughput(Throughput::Elements(DIRECTION_COUNT as u64));
    let mut rng = Pcg64::seed_from_u64(7);
    for corners in [8, 16, 32, 64, 96, 128, 192, 256, 512, 1024, 2048, 4096] {
        let tree = random_sphere_point_hull(&mut rng, corners);
        let piece = tree.hulls().get(0);
        let scan = SupportScan::new(piece.points);
        let table =
            SupportTable::new(piece.points, piece.facets).expect("the hull of a ball has facets");
        let cold: Vec<DVec3> = (0..DIRECTION_COUNT)
            .map(|_| random_direction(&mut rng))
            .collect();
        let warm = rotating_directions(&mut rng);
        group.bench_with_input(BenchmarkId::new("scan", corners), &cold, |b, looks| {
            b.iter(|| {
                looks
                    .iter()
                    .fold(0, |sum, &n| sum ^ scan.extremal_point(black_box(n)))
            });
        });
        group.bench_with_input(BenchmarkId::new("climb", corners), &cold, |b, looks| {
            b.iter(|| {
                looks
                    .iter()
                    .fold(0, |sum, &n| sum ^ table.extremal_point(black_box(n)))
            });
        });
        group.bench_with_input(
            BenchmarkId::new("climb-warm", corners),
            &warm,
            |b, looks| {
                b.iter(|| {
                    let last = table.extremal_point(looks[0]);
                    let next = |last, &n: &DVec3| table.extremal_point_from(last, black_box(n));
                    looks.iter().fold(last, next)
                });
            },
        );
    }
    group.finish();
}

/// Returns directions, each a hundredth of a radian from the one before, as in the steps of a query.
fn rotating_directions(rng: &mut Pcg64) -> Vec<DVec3> {
    let turn = DQuat::from_scaled_axis(0.01 * random_direction(rng));
    let first = random_direction(rng);
    let next = |at: &DVec3| Some(turn * *at);
    std::iter::successors(Some(first), next)
        .take(DIRECTION_COUNT)
        .collect()
}

criterion_group!(name = benches; config = criterion_settings(20, 200, 500); targets = benchmark_support_search);
criterion_main!(benches);
