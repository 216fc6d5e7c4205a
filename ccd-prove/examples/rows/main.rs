//! Proves and checks the answers to all rows of a folder of scenes, and prints what that takes.

#![allow(clippy::print_stdout, reason = "figures are its output")]

#[path = "../tally/mod.rs"]
mod tally;

use anyhow::Result;
use ccd_prove::{Body, Scene, Witness, prove};
use clap::Parser;
use rigid_ccd::mesh::{Detail, TriangleMesh, body_from_mesh};
use rigid_ccd::table::motions::MotionTable;
use rigid_ccd::{Outcome, Settings, Solver};
use std::fs::{File, write};
use std::path::PathBuf;
use std::time::Instant;
use tally::Tally;

/// The pairs of a folder of scenes: body A, body B, motions.
const SCENES: [(&str, &str, &str); 7] = [
    ("knot2880", "knot2880", "knots"),
    ("knot11520", "knot11520", "knots"),
    ("knot34560", "knot34560", "knots"),
    ("ring", "ring", "rings"),
    ("bunny70k", "bunny70k", "bunnies"),
    ("bunny26k", "bunny26k", "bunnies"),
    ("santa", "board", "santa"),
];

/// Prove and check the answers to the rows of a folder of scenes
#[derive(Parser)]
struct Args {
    /// A folder of meshes and motions
    folder: PathBuf,
    #[arg(long, default_value_t = 1e-3)]
    tolerance: f64,
    /// Every so many-th row
    #[arg(long, default_value_t = 1)]
    step: usize,
    /// Only this mesh
    #[arg(long)]
    only: Option<String>,
    /// A folder for meshes, certificates of bodies, and proofs
    #[arg(long)]
    write: Option<PathBuf>,
}

fn main() -> Result<()> {
    let args = Args::parse();
    for (a, b, motions) in SCENES {
        if args.only.as_deref().is_none_or(|only| only == a) {
            run_pair(&args, [a, b], motions)?;
        }
    }
    Ok(())
}

fn run_pair(args: &Args, names: [&str; 2], motions: &str) -> Result<()> {
    let rows = MotionTable::read(File::open(args.folder.join(format!("{motions}.csv")))?)?.rows;
    let (mut engine, mut proven, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for name in names {
        let mesh = TriangleMesh::read(args.folder.join(format!("{name}.obj")))?;
        engine.push(body_from_mesh(&mesh, Detail::Surface)?.body);
        let vertices: Vec<_> = mesh.vertices().iter().map(|v| v.to_array()).collect();
        proven.push(Body::new(&vertices, mesh.faces()));
        triangles.push(mesh.faces().len());
    }
    if let Some(folder) = &args.write {
        for (body, name) in proven.iter().zip(names) {
            write(folder.join(format!("{name}.mesh")), body.mesh())?;
            write(folder.join(format!("{name}.body")), body.certificate())?;
        }
    }
    let per_triangle = proven[0].certificate().len() as f64 / triangles[0] as f64;
    let mut solver = Solver::new().with_settings(Settings {
        tolerance: args.tolerance,
        ..Settings::DEFAULT
    });
    let mut tally = Tally::new(args.write.clone());
    for (row, motion) in rows.iter().step_by(args.step) {
        let [a, b] = [(&engine[0], motion.a), (&engine[1], motion.b)];
        solver.first_contact(a, b, motion.duration)?;
        let start = Instant::now();
        let answer = solver.first_contact(a, b, motion.duration)?;
        let solved = start.elapsed();
        let name = format!("{}-{}", names[0], row.row);
        let (until, witness) = match &answer.outcome {
            Outcome::Free { .. } => (motion.duration, None),
            Outcome::Contact { time, contact } => {
                let witness = Witness::of_two(*time, args.tolerance, contact);
                (*time, Some(witness))
            }
            other => {
                tally.fail(format!("{name}: {other:?}"));
                continue;
            }
        };
        let scene = Scene::of_two((&proven[0], motion.a), (&proven[1], motion.b), 0.0);
        tally.prove_and_check(
            &name,
            solved,
            || prove(&scene, until, witness),
            proven.iter(),
        )?;
    }
    println!("{}: {per_triangle:.1} bytes a triangle; {tally}", names[0]);
    Ok(())
}
