//! Measures questions about edges of a robot: microseconds an edge, the time to make a solver, and verdicts beside the
//! truth.
//!
//! ```sh
//! taskset -c 1 cargo run --release -p ccd-bench --example robot_edges -- FOLDER --cell A --length 0.5
//! ```
//!
//! The folder is as `ccd-bench/scripts/robot_edges/data.py` describes it. Times are those of the processor, not of the
//! clock: other programs disturb them less.

#![allow(clippy::print_stdout, reason = "the example prints figures")]

mod folder;

use anyhow::{Result, ensure};
use clap::{Parser, ValueEnum};
use rigid_ccd::Settings;
use rigid_ccd_robot::{CellSolver, PathOutcome};
use rustix::time::{ClockId, clock_gettime};
use std::path::PathBuf;
use std::time::Instant;

/// Measure questions about edges of a robot
#[derive(Parser)]
struct Args {
    /// A folder with a robot (URDF, SRDF), cells, edges and the truth
    folder: PathBuf,
    /// The name of the cell, whose obstacles are in NAME.txt
    #[arg(long, default_value = "A")]
    cell: String,
    /// The length of the edges, which are in `edges_NAME_LENGTH.bin`; the truth is in `truth_NAME_LENGTH.txt`
    #[arg(long, default_value = "0.5")]
    length: String,
    /// The folder with the meshes of the cell
    #[arg(long, default_value = ".")]
    meshes: PathBuf,
    /// How often all edges are asked
    #[arg(long, default_value_t = 11, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// The question about each edge
    #[arg(long, value_enum, default_value_t = Question::IsFree)]
    question: Question,
    #[arg(long, default_value_t = 1e-4)]
    tolerance: f64,
    /// Take times from the clock: valgrind cannot run what reads the time of the processor
    #[arg(long)]
    wall_clock: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum Question {
    IsFree,
    AnyContact,
    FirstContact,
    /// An edge is accepted if the lower bound of the distance is positive
    ClosestApproach,
}

/// How many edges got which verdict.
#[derive(Default)]
struct Verdicts {
    accepted: usize,
    accepted_in_contact: usize,
    refused_free: usize,
}

fn main() -> Result<()> {
    let args = Args::parse();
    let begin = Instant::now();
    let seconds = || {
        if args.wall_clock {
            begin.elapsed().as_secs_f64()
        } else {
            processor_seconds()
        }
    };
    let file_of_edges = |kind: &str, extension: &str| {
        let name = format!("{kind}_{}_{}.{extension}", args.cell, args.length);
        args.folder.join(name)
    };
    let numbers = folder::read_numbers(&file_of_edges("edges", "bin"))?;
    let truth = folder::read_truth(&file_of_edges("truth", "txt"))?;
    let start = seconds();
    let cell = folder::read_cell(&args.folder, &args.meshes, &args.cell)?;
    let cell_seconds = seconds() - start;

    let joints = cell.robot().independent_joint_names().len();
    let edges: Vec<[&[f64]; 2]> = (numbers.chunks_exact(2 * joints))
        .map(|edge| edge.split_at(joints).into())
        .collect();
    ensure!(
        !edges.is_empty() && edges.len() == truth.len(),
        "{} edges of {joints} joints, but the truth has {} lines",
        edges.len(),
        truth.len()
    );

    let start = seconds();
    let mut solver = cell.solver().with_settings(Settings {
        tolerance: args.tolerance,
        ..Settings::DEFAULT
    });
    solver.prepare();
    let solver_seconds = seconds() - start;

    let mut accepted = vec![false; edges.len()];
    let mut micros = Vec::new();
    for _ in 0..args.rounds {
        let start = seconds();
        for (edge, accepted) in edges.iter().zip(&mut accepted) {
            *accepted = accepts(&mut solver, args.question, edge)?;
        }
        micros.push(1e6 * (seconds() - start) / edges.len() as f64);
    }
    let first = micros[0];
    micros.sort_by(f64::total_cmp);
    let verdicts = compare(&accepted, &truth);
    println!(
        "{} {}: median {:.2} µs an edge, least {:.2}, first round {first:.2}; cell {:.1} ms, solver {:.2} ms; \
         of {} edges {} accepted, {} of them touch; {} refused are free",
        args.cell,
        args.length,
        micros[micros.len() / 2],
        micros[0],
        1e3 * cell_seconds,
        1e3 * solver_seconds,
        edges.len(),
        verdicts.accepted,
        verdicts.accepted_in_contact,
        verdicts.refused_free
    );
    Ok(())
}

/// Asks whether an edge is free of contacts. A search that reaches a limit is an error.
fn accepts(solver: &mut CellSolver<'_>, question: Question, edge: &[&[f64]; 2]) -> Result<bool> {
    let answer = match question {
        Question::IsFree => return Ok(solver.is_free(edge)?),
        Question::AnyContact => solver.any_contact(edge)?,
        Question::FirstContact => solver.first_contact(edge)?,
        Question::ClosestApproach => solver.closest_approach(edge)?,
    };
    match answer.outcome {
        PathOutcome::Free => Ok(true),
        PathOutcome::Contact(_) => Ok(false),
        PathOutcome::LeastDistance { lower, .. } => Ok(lower > 0.0),
        PathOutcome::Unresolved(unresolved) => anyhow::bail!("unresolved: {unresolved:?}"),
    }
}

/// Compares the edges that were accepted with whether they touch.
fn compare(accepted: &[bool], touching: &[bool]) -> Verdicts {
    let mut verdicts = Verdicts::default();
    for (&accepted, &touches) in accepted.iter().zip(touching) {
        verdicts.accepted += usize::from(accepted);
        verdicts.accepted_in_contact += usize::from(accepted && touches);
        verdicts.refused_free += usize::from(!accepted && !touches);
    }
    verdicts
}

/// Returns the time that this thread has been running.
fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
