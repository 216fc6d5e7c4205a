//! Benchmarks the search for contacts among two hundred bodies that fly over a terrain of 28,322 triangles, at 60 steps
//! a second.
//!
//! ```sh
//! cargo bench -p ccd-bench --bench scene
//! ```

mod settings;

use ccd_bench::scene::model::torus_knot;
use ccd_core::glam::{DQuat, DVec3};
use ccd_decomp::{PieceChoice, TriangleMesh, body_from_mesh};
use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::{Body, Motion, Pose, Scene};
use settings::criterion_settings;
use std::io::{Write, stderr};
use std::num::NonZeroUsize;

/// The duration of a step, in seconds.
const STEP_DURATION: f64 = 1.0 / 60.0;
/// The number of steps in a flight, and the number of flying bodies.
const STEP_AND_BODY_COUNTS: (u32, usize) = (20, 200);
/// The number of grid squares along each side of the terrain, and half the length of a side.
const TERRAIN_SIDE_CELLS_AND_HALF_WIDTH: (u32, f64) = (119, 30.0);

/// A function that returns the start position and the velocity of a body. Its arguments are a random vector for each of
/// the two, and the height of the ground as a vector.
type StartFunction = fn(DVec3, DVec3, DVec3) -> (DVec3, DVec3);

/// The flights by name, each with the function that gives a body its start. In turn, the bodies fall onto the hills,
/// skim along them, fly from all sides to one place, fly in all directions within a crowd, or fall ten times as fast as
/// in the first flight.
const FLIGHT_START_FUNCTIONS: [(&str, StartFunction); 5] = [
    ("hail", |place, way, _| {
        let high = DVec3::Z * (4.0 + 2.0 * place.z);
        (
            horizontal_position(place) + high,
            way * 5.0 - 20.0 * DVec3::Z,
        )
    }),
    ("skimming", |place, way, ground| {
        let low = DVec3::Z * (1.2 + 0.5 * place.z);
        let velocity = way * DVec3::new(20.0, 20.0, 1.0);
        (horizontal_position(place) + ground + low, velocity)
    }),
    ("implosion", |place, way, _| {
        let aside = place.normalize();
        (aside * 10.0 + 14.0 * DVec3::Z, -20.0 * aside + way)
    }),
    ("crowd", |place, way, _| {
        (place * 4.0 + 9.0 * DVec3::Z, way * 10.0)
    }),
    ("bullets", |place, way, _| {
        let high = DVec3::Z * (24.0 + 20.0 * place.z);
        (
            horizontal_position(place) + high,
            way * 30.0 - 200.0 * DVec3::Z,
        )
    }),
];

fn horizontal_position(place: DVec3) -> DVec3 {
    place * DVec3::new(20.0, 20.0, 0.0)
}

fn terrain_height(x: f64, y: f64) -> f64 {
    1.5 * (0.31 * x).sin() * (0.27 * y).cos() + 0.3 * (1.7 * x + 0.9 * y).sin()
}

/// Returns the body of the hills, followed by the four flying bodies: a sphere, a box, a capsule and a torus knot.
fn hills_and_bodies() -> anyhow::Result<[Body; 5]> {
    let of_mesh = |mesh: &TriangleMesh| anyhow::Ok(body_from_mesh(mesh, PieceChoice::Auto)?.body);
    let (cells, half) = TERRAIN_SIDE_CELLS_AND_HALF_WIDTH;
    let row = cells + 1;
    let vertices = (0..row * row).map(|k| {
        let [x, y] =
            [k % row, k / row].map(|n| half * (2.0 * f64::from(n) / f64::from(cells) - 1.0));
        DVec3::new(x, y, terrain_height(x, y))
    });
    let faces = (0..cells * cells).flat_map(|k| {
        let a = k / cells * row + k % cells;
        [[a, a + 1, a + row], [a + 1, a + row + 1, a + row]]
    });
    let hills = TriangleMesh::new(vertices.collect(), &faces.collect::<Vec<_>>())?;
    let knot = torus_knot([36, 8], 0.35)?;
    let smaller = knot.vertices().iter().map(|&v| 0.25 * v).collect();
    Ok([
        of_mesh(&hills)?,
        Body::sphere(0.3)?,
        Body::cuboid([0.3, 0.2, 0.4])?,
        Body::capsule(0.15, 0.4)?,
        of_mesh(&TriangleMesh::new(smaller, knot.faces())?)?,
    ])
}

/// Returns the motions of all bodies in each step of a flight.
fn flight_motions(start: StartFunction) -> anyhow::Result<Vec<Vec<Motion>>> {
    let mut rng = Pcg64::seed_from_u64(7);
    let mut any =
        |size: f64| DVec3::from_array(std::array::from_fn(|_| rng.random_range(-size..size)));
    let (steps, count) = STEP_AND_BODY_COUNTS;
    let starts = (0..count).map(|_| {
        let (place, way) = (any(1.0), any(1.0));
        let ground = horizontal_position(place);
        let ground = terrain_height(ground.x, ground.y) * DVec3::Z;
        let (place, velocity) = start(place, way, ground);
        let spin = any(10.0);
        (place, DQuat::from_scaled_axis(any(3.0)), velocity, spin)
    });
    let starts: Vec<_> = starts.collect();
    let at = |time: f64| {
        let motion = |&(place, rotation, velocity, spin): &(DVec3, DQuat, DVec3, DVec3)| {
            let turned = DQuat::from_scaled_axis(time * spin) * rotation;
            let start = Pose::new(place + time * velocity, turned)?;
            Ok(Motion::new(start, velocity, spin)?)
        };
        starts.iter().map(motion).collect()
    };
    (0..steps)
        .map(|step| at(STEP_DURATION * f64::from(step)))
        .collect()
}

/// Sets the motion of each flying body for the next step; the hills, body 0, stay at rest.
fn set_motions(scene: &mut Scene<'_>, motions: &[Motion]) {
    for (k, &motion) in motions.iter().enumerate() {
        scene
            .set_movement(k + 1, motion)
            .expect("a body that moves");
    }
}

fn benchmark_scenes(criterion: &mut Criterion) {
    let [hills, others @ ..] = &hills_and_bodies().expect("valid sizes");
    for (name, start) in FLIGHT_START_FUNCTIONS {
        let steps = flight_motions(start).expect("valid motions");
        let mut scene = Scene::with_threads(NonZeroUsize::MIN);
        scene.add_fixed(hills, Pose::IDENTITY);
        for (&motion, body) in steps[0].iter().zip(others.iter().cycle()) {
            scene.add(body, motion);
        }
        let mut contacts = 0;
        for motions in &steps {
            set_motions(&mut scene, motions);
            contacts += scene.contacts(STEP_DURATION).iter().flatten().count();
        }
        assert!(contacts > 0, "{name}: nothing to find");
        let _ = writeln!(
            stderr(),
            "{name}: {} contacts a step",
            contacts / steps.len()
        );
        let mut group = criterion.benchmark_group(format!("scene/{name}"));
        group.throughput(Throughput::Elements(steps.len() as u64));
        group.sampling_mode(SamplingMode::Flat);
        let mut ask = |question: &str, ask: fn(&mut Scene<'_>)| {
            group.bench_function(question, |bencher| {
                bencher.iter(|| {
                    for motions in &steps {
                        set_motions(&mut scene, motions);
                        ask(&mut scene);
                    }
                });
            });
        };
        ask("first of all", |scene| {
            drop(scene.first_contact(STEP_DURATION));
        });
        ask("first of each", |scene| {
            drop(scene.first_contact_of_each(STEP_DURATION));
        });
        ask("all", |scene| drop(scene.contacts(STEP_DURATION)));
        group.finish();
    }
}

criterion_group!(name = benches; config = criterion_settings(10, 300, 1000); targets = benchmark_scenes);
criterion_main!(benches);
