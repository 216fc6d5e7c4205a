//! Benchmarks two tasks: the decomposition of a mesh into convex patches, and the creation of a body from a mesh.
//!
//! ```sh
//! cargo bench -p ccd-bench --bench decomposition
//! ```

mod settings;

use ccd_bench::scene::model::Model;
use ccd_decomp::{PatchOrder, PieceChoice, TriangleMesh, body_from_mesh, decompose};
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use settings::criterion_settings;
use std::hint::black_box;

/// The torus knots to decompose, which differ in size only.
const KNOT_MODELS: [Model; 3] = [Model::Knot2880, Model::Knot11520, Model::Knot34560];

fn knot_meshes() -> Vec<(String, TriangleMesh)> {
    KNOT_MODELS
        .iter()
        .map(|knot| {
            (
                knot.name(),
                knot.generate().expect("every model can be made"),
            )
        })
        .collect()
}

/// Benchmarks the decomposition of surfaces into convex patches, with each order in which a patch can grow.
fn benchmark_decompositions(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("decompose");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    for (name, mesh) in &knot_meshes() {
        group.throughput(Throughput::Elements(mesh.faces().len() as u64));
        for (order, id) in [
            (PatchOrder::Cresting, "cresting"),
            (PatchOrder::BreadthFirst, "breadth-first"),
            (PatchOrder::DepthFirst, "depth-first"),
        ] {
            assert_patches_partition_mesh(mesh, order);
            group.bench_with_input(BenchmarkId::new(id, name), mesh, |bencher, mesh| {
                bencher.iter(|| decompose(black_box(mesh), order).expect("a knot bounds a solid"));
            });
        }
    }
    group.finish();
}

/// Asserts that every triangle of the mesh is in exactly one patch of its decomposition.
fn assert_patches_partition_mesh(mesh: &TriangleMesh, order: PatchOrder) {
    let patches = decompose(mesh, order)
        .expect("a knot bounds a solid")
        .patches;
    let mut faces: Vec<u32> = patches
        .iter()
        .flat_map(|patch| &patch.faces)
        .copied()
        .collect();
    faces.sort_unstable();
    assert!(faces.iter().copied().eq(0..mesh.faces().len() as u32));
}

/// Benchmarks the creation of a body from a mesh, with each kind of pieces.
fn benchmark_body_creation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("body");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    for (name, mesh) in &knot_meshes() {
        group.throughput(Throughput::Elements(mesh.faces().len() as u64));
        for (choice, id) in [
            (PieceChoice::Triangles, "triangles"),
            (PieceChoice::Patches(PatchOrder::Cresting), "patches"),
            (PieceChoice::Auto, "auto"),
        ] {
            group.bench_with_input(BenchmarkId::new(id, name), mesh, |bencher, mesh| {
                bencher.iter(|| body_from_mesh(black_box(mesh), choice).expect("a knot is a body"));
            });
        }
    }
    group.finish();
}

criterion_group!(name = benches; config = criterion_settings(100, 500, 2000); targets = benchmark_decompositions, benchmark_body_creation);
criterion_main!(benches);
