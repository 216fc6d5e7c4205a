//! Shows how one changed line switches from parry's cast to the certified one: `cargo run --release -p rigid-ccd-parry
//! --example switch`.
//!
//! Shapes turn while they fly at a torus of triangles. parry's nonlinear cast may be late; parry's own test of shapes at
//! rest, at a thousand times before its hit, tells by how much. The certified cast never is.
//!
//! Then what a cast in every frame of a game costs, of shapes that turn slowly: parry's own, the function with parry's
//! signature, and a `Caster`. Times are medians of a few hundred casts, after the first one.
#![allow(clippy::print_stdout, reason = "it shows and measures")]

use anyhow::Result;
use parry3d::math::{Pose, Vector};
use parry3d::query::{NonlinearRigidMotion, cast_shapes_nonlinear as before, intersection_test};
use parry3d::shape::{SharedShape, TriMesh};
use rigid_ccd_parry::Options;
// The line.
use rigid_ccd_parry::f32::cast_shapes_nonlinear;
use rigid_ccd_parry::f32::{Caster, body};
use std::f32::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

fn main() -> Result<()> {
    let rests = NonlinearRigidMotion::identity();
    let mut flies = NonlinearRigidMotion::constant_position(Pose::translation(-3.0, 0.1, 0.2));
    flies.linvel = 4.0 * Vector::X;
    flies.angvel = Vector::new(1.0, 2.0, 3.0);
    let small = [
        ("ball", SharedShape::ball(0.5)),
        ("box", SharedShape::cuboid(0.5, 0.4, 0.3)),
        ("capsule", SharedShape::capsule_y(0.5, 0.2)),
        ("cylinder", SharedShape::cylinder(0.5, 0.4)),
    ];
    let large = [
        ("box", SharedShape::cuboid(0.5, 0.4, 0.3)),
        ("torus, 800 triangles", torus(20)?),
        ("torus, 80,000 triangles", torus(200)?),
    ];
    let ring = &large[1].1;
    println!("shape     parry     they touch before  certified  they touch before");
    for (name, shape) in &small {
        let parry = before(&flies, &**shape, &rests, &**ring, 0.0, 1.0, true)?;
        let ours = cast_shapes_nonlinear(&flies, &**shape, &rests, &**ring, 0.0, 1.0, true)?;
        print!("{name:8}");
        for hit in [parry, ours] {
            let time = hit.map_or(1.0, |hit| hit.time_of_impact);
            let at = |k: u16| time * f32::from(k) / 1000.0;
            let touch = |k: &u16| {
                let pose = flies.position_at_time(at(*k));
                intersection_test(&pose, &**shape, &Pose::IDENTITY, &**ring)
                    .is_ok_and(|test| test.intersecting)
            };
            let first = (0..1000).find(touch);
            let first = first.map_or("no".to_owned(), |k| format!("from {:.4}", at(k)));
            print!("  {time:<8.6}  {first:17}");
        }
        println!();
    }
    flies.angvel *= 0.1;
    let mut caster = Caster::default();
    println!("\n{:35}      parry   function     Caster  us", "");
    for (name, a) in &small {
        for (other, b) in &large {
            let parry = median_micros(|| before(&flies, &**a, &rests, &**b, 0.0, 1.0, true));
            let function =
                median_micros(|| cast_shapes_nonlinear(&flies, &**a, &rests, &**b, 0.0, 1.0, true));
            let kept = median_micros(|| {
                caster.cast_shapes_nonlinear(&flies, a, &rests, b, 0.0, 1.0, true)
            });
            println!("{name:10} {other:24} {parry:10.1} {function:10.1} {kept:10.1}");
        }
    }
    for (name, shape) in small.iter().chain(&large) {
        let made = median_micros(|| body(&**shape, &Options::default()));
        println!("to make {name}: {made:.1} us");
    }
    Ok(())
}

/// Returns the median time of a call, in microseconds.
fn median_micros<T>(mut call: impl FnMut() -> T) -> f64 {
    call();
    let began = Instant::now();
    let mut times = Vec::new();
    while times.len() < 300 && (times.len() < 5 || began.elapsed().as_millis() < 200) {
        let start = Instant::now();
        black_box(call());
        times.push(start.elapsed().as_secs_f64() * 1e6);
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn torus(sides: u32) -> Result<SharedShape> {
    let at = |i: u32, j: u32| (i % sides) * sides + j % sides;
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for (i, j) in (0..sides).flat_map(|i| (0..sides).map(move |j| (i, j))) {
        let [a, b] = [i, j].map(|k| TAU * k as f32 / sides as f32);
        let out = 1.0 + 0.3 * b.cos();
        vertices.push(Vector::new(out * a.cos(), out * a.sin(), 0.3 * b.sin()));
        faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
        faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    Ok(SharedShape::new(TriMesh::new(vertices, faces)?))
}
