//! Proves and checks the first contacts on edges of a robot, and prints the sizes and times.

#![allow(clippy::print_stdout, reason = "the example prints figures")]

#[path = "../proof_tally/mod.rs"]
mod tally;

use anyhow::{Context, Result, ensure};
use ccd_prove::ProvenCell;
use clap::Parser;
use rigid_ccd::{Body, Pose, Settings, load};
use rigid_ccd_robot::{Cell, RobotFile};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;
use tally::Tally;

/// Prove and check the first contacts on edges of a robot
#[derive(Parser)]
struct Args {
    /// A folder with a robot (URDF, SRDF), cells and edges
    folder: PathBuf,
    /// The name of the cell, whose obstacles are in NAME.txt
    #[arg(long, default_value = "A")]
    cell: String,
    /// The length of the edges, which are in edges_NAME_LENGTH.bin
    #[arg(long, default_value = "0.5")]
    length: String,
    /// The folder with the meshes of the cell
    #[arg(long, default_value = ".")]
    meshes: PathBuf,
    #[arg(long, default_value_t = 1e-3)]
    tolerance: f64,
    /// Use every STEP-th edge
    #[arg(long, default_value_t = 1)]
    step: usize,
    /// Write the meshes, the certificates of bodies and the proofs to this folder
    #[arg(long)]
    write: Option<PathBuf>,
}

fn main() -> Result<()> {
    let args = Args::parse();
    let cell = read_cell(&args)?;
    let proven = ProvenCell::new(&cell)?;
    let settings = Settings {
        tolerance: args.tolerance,
        ..Settings::DEFAULT
    };
    let mut solver = cell.solver().with_settings(settings.clone());
    let bytes = fs::read(
        args.folder
            .join(format!("edges_{}_{}.bin", args.cell, args.length)),
    )?;
    let numbers: Vec<f64> = (bytes.chunks_exact(8))
        .map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap_or_default()))
        .collect();
    let joints = cell.robot().independent_joint_names().len();
    if let Some(folder) = &args.write {
        for (number, body) in proven.meshes().enumerate() {
            fs::write(folder.join(format!("{number}.mesh")), body.mesh())?;
            fs::write(folder.join(format!("{number}.body")), body.certificate())?;
        }
    }
    let mut tally = Tally::new(args.write.clone());
    for (row, edge) in numbers
        .chunks_exact(2 * joints)
        .enumerate()
        .step_by(args.step)
    {
        let (from, to) = edge.split_at(joints);
        let path = [from.to_vec(), to.to_vec()];
        solver.first_contact(&path)?;
        let start = Instant::now();
        let answer = solver.first_contact(&path)?;
        let solved = start.elapsed();
        let name = format!("edge-{row}");
        if answer.outcome.limit().is_some() {
            tally.fail(format!("{name}: {answer:?}"));
            continue;
        }
        let prove = || {
            let proofs = proven.prove_path(&path, &answer, &settings);
            proofs.map(|mut proofs| proofs.pop()).transpose()
        };
        tally.prove_and_check(&name, solved, prove, proven.meshes())?;
    }
    println!("cell {}, edges of {}: {}", args.cell, args.length, tally);
    Ok(())
}

/// Reads the robot and the obstacles of a cell.
fn read_cell(args: &Args) -> Result<Cell> {
    let file_with = |extension: &str| -> Result<PathBuf> {
        let mut paths = fs::read_dir(&args.folder)?.filter_map(|entry| Some(entry.ok()?.path()));
        let found = paths.find(|path| path.extension().is_some_and(|other| other == extension));
        found.with_context(|| format!("{} has no .{extension}", args.folder.display()))
    };
    let file = RobotFile::from_path(&file_with("urdf")?);
    let robot = file.read()?;
    let pairs = file.link_pairs(&robot, Some(&file_with("srdf")?))?;
    let mut cell = Cell::new(robot, pairs);
    let lines = fs::read_to_string(args.folder.join(format!("{}.txt", args.cell)))?;
    for (number, line) in lines.lines().enumerate() {
        add_obstacle(&mut cell, &args.meshes, number, line).with_context(|| line.to_owned())?;
    }
    Ok(cell)
}

/// Adds an obstacle from a line of text: its shape, the sizes of the shape or the name of its mesh, and its pose.
fn add_obstacle(cell: &mut Cell, meshes: &Path, number: usize, line: &str) -> Result<()> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let numbers: Vec<f64> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let [sizes @ .., x, y, z, qw, qx, qy, qz] = &numbers[..] else {
        anyhow::bail!("the line needs a pose of seven numbers at its end");
    };
    ensure!(
        words.len() > 1,
        "the shape needs a size or the name of a mesh"
    );
    let body = match (words[0], sizes) {
        ("box", &[x, y, z]) => Body::cuboid([x, y, z])?,
        ("sphere", &[radius]) => Body::sphere(radius)?,
        ("capsule", &[radius, half]) => Body::capsule(radius, half)?,
        _ => load(meshes.join(format!("{}.obj", words[1])))?,
    };
    let pose = Pose::new([*x, *y, *z], [*qx, *qy, *qz, *qw])?;
    Ok(cell.add_obstacle(format!("{}{number}", words[0]), body, pose)?)
}
