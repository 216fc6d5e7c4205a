//! Proves and checks the answers for all rows of a folder of scenes, and prints the sizes and times.

#![allow(clippy::print_stdout, reason = "the example prints figures")]

#[path = "../proof_tally/mod.rs"]
mod tally;

use anyhow::Result;
use ccd_prove::ProvenPair;
use ccd_tables::motions::MotionTable;
use clap::Parser;
use rigid_ccd::mesh::{PieceChoice, TriangleMesh, body_from_mesh};
use rigid_ccd::{Outcome, Settings, Solver};
use std::fs::{File, write};
use std::path::PathBuf;
use std::time::Instant;
use tally::Tally;

/// The scenes of the folder: the meshes of A and B, and the table of motions.
const SCENES: [(&str, &str, &str); 7] = [
    ("knot2880", "knot2880", "knots"),
    ("knot11520", "knot11520", "knots"),
    ("knot34560", "knot34560", "knots"),
    ("ring", "ring", "rings"),
    ("bunny70k", "bunny70k", "bunnies"),
    ("bunny26k", "bunny26k", "bunnies"),
    ("santa", "board", "santa"),
];

/// Prove and check the answers for the rows of a folder of scenes
#[derive(Parser)]
struct Args {
    /// The folder with the meshes and motions
    folder: PathBuf,
    #[arg(long, default_value_t = 1e-3)]
    tolerance: f64,
    /// Use every STEP-th row
    #[arg(long, default_value_t = 1)]
    step: usize,
    /// Use only the scene whose mesh A has this name
    #[arg(long)]
    only: Option<String>,
    /// Write the meshes, the certificates of bodies and the proofs to this folder
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
    let meshes = names.map(|name| TriangleMesh::read(args.folder.join(format!("{name}.obj"))));
    let meshes: Vec<TriangleMesh> = meshes.into_iter().collect::<Result<_, _>>()?;
    let engine = meshes
        .iter()
        .map(|mesh| body_from_mesh(mesh, PieceChoice::Surface));
    let engine: Vec<_> = engine.collect::<Result<_, _>>()?;
    let [a, b] = [&engine[0].body, &engine[1].body];
    let proven = ProvenPair::new(a, b)?;
    if let Some(folder) = &args.write {
        for (body, name) in proven.meshes().into_iter().zip(names) {
            write(folder.join(format!("{name}.mesh")), body.mesh())?;
            write(folder.join(format!("{name}.body")), body.certificate())?;
        }
    }
    let [certificate, triangles] = [
        proven.meshes()[0].certificate().len(),
        meshes[0].faces().len(),
    ];
    let per_triangle = certificate as f64 / triangles as f64;
    let settings = Settings {
        tolerance: args.tolerance,
        ..Settings::DEFAULT
    };
    let mut solver = Solver::new().with_settings(settings.clone());
    let mut tally = Tally::new(args.write.clone());
    for (row, motion) in rows.iter().step_by(args.step) {
        let mut ask = || solver.first_contact((a, motion.a), (b, motion.b), motion.duration);
        ask()?;
        let start = Instant::now();
        let answer = ask()?;
        let solved = start.elapsed();
        let name = format!("{}-{}", names[0], row.row);
        let motions = [motion.a, motion.b];
        let prove = || proven.prove(motions, motion.duration, &settings, &answer);
        let is_decided = matches!(
            answer.outcome,
            Outcome::Free { .. } | Outcome::Contact { .. }
        );
        if is_decided {
            tally.prove_and_check(&name, solved, prove, proven.meshes())?;
        } else {
            tally.fail(format!("{name}: {:?}", answer.outcome));
        }
    }
    println!("{}: {per_triangle:.1} bytes a triangle; {tally}", names[0]);
    Ok(())
}
