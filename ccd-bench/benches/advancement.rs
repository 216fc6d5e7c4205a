//! Benchmarks whole queries with every schedule and distance backend, on queries picked evenly from each scene. Every
//! answer is checked against the truth before it is timed.
//!
//! ```sh
//! cargo bench -p ccd-bench --bench advancement
//! cargo bench -p ccd-bench --bench advancement -- santa
//! ```

mod settings;

use ccd_bench::method::PAPER_TOLERANCE;
use ccd_bench::method::guarded::MethodPrograms;
use ccd_bench::method::solver::Solver;
use ccd_bench::method::{Method, ProjectSolver};
use ccd_bench::run::contest::{MeasurementLimits, PreparedScene, Session};
use ccd_bench::scene::{ModelBodyCache, PieceKind, scene_descriptions};
use ccd_core::Settings;
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use rigid_ccd_cli::ScheduleKind;
use settings::criterion_settings;
use std::time::Duration;

/// The number of queries to measure in each scene, picked evenly from its table of motions.
const ROWS_PER_SCENE: usize = 32;
/// The names of the scenes to measure, chosen so that no mesh is in two of them.
const SCENE_NAMES: [&str; 7] = [
    "santa",
    "bunny turning",
    "knot2880 turning",
    "knot11520 turning",
    "knot34560 turning",
    "falling rings",
    NAIVE_SCHEDULE_SCENE,
];
/// The name of the only scene with few enough pairs of pieces for the naive schedule, which is the slowest.
const NAIVE_SCHEDULE_SCENE: &str = "knot216";

fn benchmark_queries(criterion: &mut Criterion) {
    let mut models = ModelBodyCache::default();
    let scene_descriptions = scene_descriptions().expect("the scenes' data");
    for listing in scene_descriptions
        .iter()
        .filter(|l| SCENE_NAMES.contains(&l.name.as_str()))
    {
        let scene = listing
            .make_scene(&mut models)
            .expect("scenes made by code");
        let contest = PreparedScene::new(&scene).expect("motions with screws");
        let rows = contest.spread_row_indices(ROWS_PER_SCENE);
        let mut group = criterion.benchmark_group(format!("advancement/{}", scene.name));
        group.throughput(Throughput::Elements(rows.len() as u64));
        group.sampling_mode(SamplingMode::Flat);
        for method in Method::built_in_methods() {
            let Method::ThisProject(kind, pieces @ (PieceKind::FewestPieces | PieceKind::Patches)) =
                method
            else {
                continue;
            };
            // The schedule that advances all pairs in every step runs on one scene only.
            if kind.schedule == ScheduleKind::Naive && scene.name != NAIVE_SCHEDULE_SCENE {
                continue;
            }
            // A method that does not support the scene is not timed. A wrong answer stops the benchmark.
            if !assert_right_if_supported(&contest, method) {
                continue;
            }
            let bodies = scene
                .bodies_with_pieces(pieces)
                .expect("it has just opened a session");
            let mut solver = ProjectSolver::new(kind, bodies, Settings::DEFAULT.margin);
            group.bench_function(BenchmarkId::from_parameter(method), |bencher| {
                bencher.iter(|| {
                    let steps =
                        |&row: &usize| solver.answer(&scene.queries[row], PAPER_TOLERANCE).steps;
                    rows.iter().map(steps).sum::<u64>()
                });
            });
        }
        group.finish();
    }
}

/// Returns true if the method supports the scene, after asserting that all its answers are right.
fn assert_right_if_supported(contest: &PreparedScene<'_>, method: Method) -> bool {
    let allowance = MeasurementLimits {
        cell_time: Duration::MAX,
        patience: Duration::MAX,
        max_rows: ROWS_PER_SCENE,
        min_rows: ROWS_PER_SCENE,
        preparation_limit: Duration::MAX,
    };
    let session = Session::open(method, contest.scene(), &MethodPrograms::default());
    let session = session.expect("no peer is asked");
    session.is_some_and(|mut session| {
        let measured = contest.run(&mut session, PAPER_TOLERANCE, &allowance);
        let (cell, _) = measured
            .expect("no peer is asked")
            .expect("all queries can be asked");
        let wrong = cell.late + cell.missed + cell.false_contacts + cell.early;
        assert_eq!(wrong + cell.unresolved, 0, "{cell:?}");
        true
    })
}

criterion_group!(name = benches; config = criterion_settings(10, 300, 1000); targets = benchmark_queries);
criterion_main!(benches);
