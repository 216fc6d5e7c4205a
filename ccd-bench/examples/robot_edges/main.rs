//! Measures questions about paths of a robot: microseconds a path, the time to make a solver, and verdicts beside the
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
use rigid_ccd_robot::{CellSolver, JointCurve, PathOutcome};
use rustix::time::{ClockId, clock_gettime};
use std::path::PathBuf;
use std::time::Instant;

/// Measure questions about paths of a robot
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
    /// The paths that are asked
    #[arg(long, value_enum, default_value_t = Paths::Edges)]
    paths: Paths,
    /// The question about each path
    #[arg(long, value_enum, default_value_t = Question::IsFree)]
    question: Question,
    #[arg(long, default_value_t = 1e-4)]
    tolerance: f64,
    /// Take times from the clock: valgrind cannot run what reads the time of the processor
    #[arg(long)]
    wall_clock: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Paths {
    Edges,
    /// The same edges as cubic curves that begin and end at rest
    Curves,
    /// The paths of 50 configurations in `chunks_NAME.bin`, without a truth
    Chunks,
}

/// A path to ask about.
enum TestPath<'n> {
    Configurations(Vec<&'n [f64]>),
    Curve(JointCurve),
}

#[derive(Clone, Copy, ValueEnum)]
enum Question {
    IsFree,
    AnyContact,
    FirstContact,
    /// An edge is accepted if the lower bound of the distance is positive
    ClosestApproach,
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
    let (numbers, count) = match args.paths {
        Paths::Edges | Paths::Curves => (file_of_edges("edges", "bin"), 2),
        Paths::Chunks => (args.folder.join(format!("chunks_{}.bin", args.cell)), 50),
    };
    let numbers = folder::read_numbers(&numbers)?;
    let start = seconds();
    let cell = folder::read_cell(&args.folder, &args.meshes, &args.cell)?;
    let cell_seconds = seconds() - start;

    let joints = cell.robot().independent_joint_names().len();
    let paths = numbers.chunks_exact(count * joints);
    let paths = paths.map(|path| TestPath::new(args.paths, path.chunks_exact(joints).collect()));
    let paths = paths.collect::<Result<Vec<TestPath<'_>>>>()?;
    let truth = match args.paths {
        Paths::Edges | Paths::Curves => Some(folder::read_truth(&file_of_edges("truth", "txt"))?),
        Paths::Chunks => None,
    };
    let (known, asked) = (truth.as_ref().map_or(paths.len(), Vec::len), paths.len());
    ensure!(
        asked > 0 && asked == known,
        "{asked} paths of {joints} joints, but the truth has {known} lines"
    );

    let start = seconds();
    let mut solver = cell.solver().with_settings(Settings {
        tolerance: args.tolerance,
        ..Settings::DEFAULT
    });
    solver.prepare();
    let solver_seconds = seconds() - start;

    let mut accepted = vec![false; asked];
    let mut rounds = Vec::new();
    let mut times = vec![Vec::new(); asked];
    for _ in 0..args.rounds {
        let start = seconds();
        for ((path, accepted), times) in paths.iter().zip(&mut accepted).zip(&mut times) {
            // Reading the clock takes a part of an edge's time.
            let begin = (args.paths == Paths::Chunks).then(seconds);
            *accepted = accepts(&mut solver, args.question, path)?;
            times.extend(begin.map(|begin| seconds() - begin));
        }
        rounds.push(1e6 * (seconds() - start) / asked as f64);
    }
    let first = rounds[0];
    rounds.sort_by(f64::total_cmp);
    println!(
        "{} {}: median {:.2} µs a path, least {:.2}, first round {first:.2}; cell {:.1} ms, solver {:.2} ms",
        args.cell,
        args.length,
        rounds[rounds.len() / 2],
        rounds[0],
        1e3 * cell_seconds,
        1e3 * solver_seconds,
    );
    print_verdicts(&accepted, truth.as_deref());
    if args.paths == Paths::Chunks {
        print_quantiles(times);
    }
    Ok(())
}

/// Prints quantiles of the median times of all paths.
fn print_quantiles(mut times: Vec<Vec<f64>>) {
    let medians = times.iter_mut().map(|times| {
        times.sort_by(f64::total_cmp);
        1e6 * times[times.len() / 2]
    });
    let mut medians: Vec<f64> = medians.collect();
    medians.sort_by(f64::total_cmp);
    let quantile = |fraction: f64| medians[(fraction * (medians.len() - 1) as f64) as usize];
    println!(
        "of paths: median {:.1} µs, 99 % {:.1}, most {:.1}",
        quantile(0.5),
        quantile(0.99),
        quantile(1.0)
    );
}

impl<'n> TestPath<'n> {
    fn new(kind: Paths, configurations: Vec<&'n [f64]>) -> Result<Self> {
        Ok(match kind {
            Paths::Edges | Paths::Chunks => TestPath::Configurations(configurations),
            Paths::Curves => {
                let still = vec![vec![0.0; configurations[0].len()]; 2];
                let (starts, still) = (
                    [configurations[0], configurations[1]],
                    [&still[0][..], &still[1]],
                );
                TestPath::Curve(JointCurve::cubic_hermite(&[0.0, 1.0], &starts, &still)?)
            }
        })
    }
}

/// Asks whether a path is free of contacts. A search that reaches a limit is an error.
fn accepts(solver: &mut CellSolver<'_>, question: Question, path: &TestPath<'_>) -> Result<bool> {
    match path {
        TestPath::Configurations(path) => accepts_path(solver, question, &path[..]),
        TestPath::Curve(curve) => accepts_path(solver, question, curve),
    }
}

fn accepts_path<P: rigid_ccd_robot::Path + ?Sized>(
    solver: &mut CellSolver<'_>,
    question: Question,
    path: &P,
) -> Result<bool> {
    let answer = match question {
        Question::IsFree => return Ok(solver.is_free(path)?),
        Question::AnyContact => solver.any_contact(path)?,
        Question::FirstContact => solver.first_contact(path)?,
        Question::ClosestApproach => solver.closest_approach(path)?,
    };
    match answer.outcome {
        PathOutcome::Free => Ok(true),
        PathOutcome::Contact(_) => Ok(false),
        PathOutcome::LeastDistance { lower, .. } => Ok(lower > 0.0),
        PathOutcome::Unresolved(unresolved) => anyhow::bail!("unresolved: {unresolved:?}"),
    }
}

/// Prints how many paths are accepted, and compares them with whether they touch.
fn print_verdicts(accepted: &[bool], touching: Option<&[bool]>) {
    let count = |verdicts: &mut dyn Iterator<Item = bool>| verdicts.filter(|&it| it).count();
    let all = count(&mut accepted.iter().copied());
    print!("of {} paths {all} accepted", accepted.len());
    if let Some(touching) = touching {
        let both = || accepted.iter().zip(touching);
        let wrongly_accepted = count(&mut both().map(|(&accepted, &touches)| accepted && touches));
        let refused = count(&mut both().map(|(&accepted, &touches)| !accepted && !touches));
        print!(", {wrongly_accepted} of them touch; {refused} refused are free");
    }
    println!();
}

/// Returns the time that this thread has been running.
fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
