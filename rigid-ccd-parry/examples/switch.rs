//! The switch from parry, in one line: `cargo run --release -p rigid-ccd-parry --example switch`.
//!
//! Shapes turn while they fly at a ring of triangles. parry's nonlinear cast may be late; parry's own test of shapes at
//! rest, at a thousand times before its hit, tells by how much. The certified cast never is.

use anyhow::Result;
use parry3d::math::{Pose, Vector};
use parry3d::query::{NonlinearRigidMotion, cast_shapes_nonlinear as before, intersection_test};
use parry3d::shape::{SharedShape, TriMesh};
// The line.
use rigid_ccd_parry::f32::cast_shapes_nonlinear;
use std::f32::consts::TAU;
use std::io::Write;

fn main() -> Result<()> {
    let ring = ring(20)?;
    let rests = NonlinearRigidMotion::identity();
    let mut flies = NonlinearRigidMotion::constant_position(Pose::translation(-3.0, 0.1, 0.2));
    flies.linvel = 4.0 * Vector::X;
    flies.angvel = Vector::new(1.0, 2.0, 3.0);
    let shapes = [
        ("ball", SharedShape::ball(0.5)),
        ("box", SharedShape::cuboid(0.5, 0.4, 0.3)),
        ("capsule", SharedShape::capsule_y(0.5, 0.2)),
        ("cylinder", SharedShape::cylinder(0.5, 0.4)),
    ];
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "shape     parry     they touch before  certified  they touch before"
    )?;
    for (name, shape) in &shapes {
        let parry = before(&flies, &**shape, &rests, &ring, 0.0, 1.0, true)?;
        let ours = cast_shapes_nonlinear(&flies, &**shape, &rests, &ring, 0.0, 1.0, true)?;
        write!(out, "{name:8}")?;
        for hit in [parry, ours] {
            let time = hit.map_or(1.0, |hit| hit.time_of_impact);
            let touch = |k: u16| {
                let at = flies.position_at_time(time * f32::from(k) / 1000.0);
                intersection_test(&at, &**shape, &Pose::IDENTITY, &ring)
                    .is_ok_and(|test| test.intersecting)
            };
            let first = (0..1000).find(|k| touch(*k));
            let first = first.map_or("no".to_owned(), |k| {
                format!("from {:.4}", time * f32::from(k) / 1000.0)
            });
            write!(out, "  {time:<8.6}  {first:17}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn ring(sides: u32) -> Result<TriMesh> {
    let at = |i: u32, j: u32| (i % sides) * sides + j % sides;
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for (i, j) in (0..sides).flat_map(|i| (0..sides).map(move |j| (i, j))) {
        let [a, b] = [i, j].map(|k| TAU * k as f32 / sides as f32);
        let out = 1.0 + 0.3 * b.cos();
        vertices.push(Vector::new(out * a.cos(), out * a.sin(), 0.3 * b.sin()));
        faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
        faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    Ok(TriMesh::new(vertices, faces)?)
}
