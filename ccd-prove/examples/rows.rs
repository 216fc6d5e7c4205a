//! Proves and checks the answers to all rows of a folder of scenes, and prints what that takes.

#![allow(clippy::print_stdout, reason = "figures are its output")]

use anyhow::Result;
use ccd_prove::{Body, Claim, prove};
use clap::Parser;
use rigid_ccd::mesh::{Detail, TriangleMesh, body_from_mesh};
use rigid_ccd::table::motions::MotionTable;
use rigid_ccd::{Outcome, Settings, Solver};
use std::fs::{File, read_to_string, write};
use std::path::{Path, PathBuf};
use std::time::Instant;

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

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Reads vertices and triangles of an OBJ file.
fn read_obj(path: &Path) -> Result<Mesh> {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for line in read_to_string(path)?.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z, ..] => vertices.push([x.parse()?, y.parse()?, z.parse()?]),
            ["f", a, b, c] => {
                let corner = |word: &str| -> Result<u32> {
                    Ok(word.split('/').next().unwrap_or(word).parse::<u32>()? - 1)
                };
                faces.push([corner(a)?, corner(b)?, corner(c)?]);
            }
            _ => {}
        }
    }
    Ok((vertices, faces))
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
    let meshes = names.map(|name| read_obj(&args.folder.join(format!("{name}.obj"))));
    let [mesh_a, mesh_b] = meshes;
    let meshes = [mesh_a?, mesh_b?];
    let mut engine = Vec::new();
    let mut proven = Vec::new();
    for (vertices, faces) in &meshes {
        let mesh = TriangleMesh::new(vertices.clone(), faces)?;
        engine.push(body_from_mesh(&mesh, Detail::Surface)?.body);
        proven.push(Body::new(vertices, faces));
    }
    if let Some(folder) = &args.write {
        for (body, name) in proven.iter().zip(names) {
            write(folder.join(format!("{name}.mesh")), body.mesh())?;
            write(folder.join(format!("{name}.body")), body.certificate())?;
        }
    }
    let per_triangle = proven[0].certificate().len() as f64 / meshes[0].1.len() as f64;
    let mut solver = Solver::new().with_settings(Settings {
        tolerance: args.tolerance,
        ..Settings::DEFAULT
    });
    let (mut bytes, mut ratios, mut leaves, mut failed) = (vec![], vec![], vec![], vec![]);
    let mut proving = vec![];
    let mut checked: Option<(i32, [ccd_check::Body; 2])> = None;
    for (row, motion) in rows.iter().step_by(args.step) {
        let bodies = ((&engine[0], motion.a), (&engine[1], motion.b));
        solver.first_contact(bodies.0, bodies.1, motion.duration)?;
        let start = Instant::now();
        let answer = solver.first_contact(bodies.0, bodies.1, motion.duration)?;
        let solved = start.elapsed().as_secs_f64();
        let claim = match &answer.outcome {
            Outcome::Free { .. } => Claim::Free,
            Outcome::Contact { time, contact } => Claim::Contact {
                time: *time,
                tolerance: args.tolerance,
                witnesses: [contact.separation.witness_a, contact.separation.witness_b],
            },
            other => {
                failed.push(format!("{row}: {other:?}"));
                continue;
            }
        };
        let start = Instant::now();
        let proof = match prove(
            (&proven[0], motion.a),
            (&proven[1], motion.b),
            (motion.duration, 0.0),
            claim,
        ) {
            Ok(proof) => proof,
            Err(error) => {
                failed.push(format!("{row}: {error}"));
                continue;
            }
        };
        if let Some(folder) = &args.write {
            let name = format!("{}-{}.proof", names[0], bytes.len());
            write(folder.join(name), &proof.bytes)?;
        }
        proving.push(start.elapsed().as_secs_f64() / solved);
        if checked.as_ref().is_none_or(|(unit, _)| *unit != proof.unit) {
            let read = |body: &Body| {
                ccd_check::Body::new(body.mesh(), body.certificate(), proof.unit)
                    .map_err(|verdict| anyhow::anyhow!("{verdict:?}"))
            };
            checked = Some((proof.unit, [read(&proven[0])?, read(&proven[1])?]));
        }
        let Some((_, [a, b])) = &checked else {
            continue;
        };
        let start = Instant::now();
        let verdict = ccd_check::check(a, b, &proof.bytes);
        ratios.push(start.elapsed().as_secs_f64() / solved);
        if verdict.is_err() {
            failed.push(format!("{row}: {verdict:?}"));
        }
        bytes.push(proof.bytes.len() as f64);
        leaves.push(proof.leaves as f64);
    }
    let summary = |numbers: &mut Vec<f64>| {
        numbers.sort_by(f64::total_cmp);
        let last = numbers.len().saturating_sub(1);
        (numbers.get(last / 2).copied(), numbers.last().copied())
    };
    println!(
        "{}: {per_triangle:.1} bytes a triangle; of each proof median and most: bytes {:?}, leaves {:?}, proving / solving {:?}, \
         checking / solving {:?}; {} failed of {}",
        names[0],
        summary(&mut bytes),
        summary(&mut leaves),
        summary(&mut proving),
        summary(&mut ratios),
        failed.len(),
        rows.len().div_ceil(args.step),
    );
    for text in failed.iter().take(3) {
        println!("  {text}");
    }
    Ok(())
}
