//! Checks chunks of waypoints under a deadline on several threads: allocations, times, and prefixes against the truth.

use crate::folder::{
    Handle, cell_solver, cells, check, default_settings, empty_path_answer, read_numbers,
    rust_settings,
};
use crate::tally::{Answered, Tally, on_threads, report};
use anyhow::Result;
use ccd_core::order::lesser;
use rigid_ccd_c::*;
use rigid_ccd_robot::Cell;
use std::path::PathBuf;
use std::ptr::null;

/// The number of waypoints of a chunk in the file.
const WAYPOINTS: usize = 50;

/// The seed of the chunks that warm a solver, which no thread has.
const WARM_UP_SEED: u64 = 1 << 32;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// A folder with a robot, cells and chunks
    folder: PathBuf,
    /// A folder of the meshes of its cells
    #[arg(long, default_value = ".")]
    meshes: PathBuf,
    /// The cell
    #[arg(long, default_value = "A")]
    cell: String,
    /// The deadline in microseconds; none if it is left out
    #[arg(long)]
    deadline: Option<f64>,
    /// The number of chunks, of all threads together
    #[arg(long, default_value_t = 100_000)]
    chunks: usize,
    #[arg(long, default_value_t = 2)]
    threads: usize,
    /// The number of chunks by which each solver is warmed, without a deadline
    #[arg(long, default_value_t = 20_000)]
    warm_up: usize,
}

/// A chunk of the file, with where it first touches.
struct Chunk {
    positions: Vec<f64>,
    /// A point of the path that nothing touches before, and one by which something has come within the tolerance; infinite if
    /// the chunk is free.
    touches_at: f64,
}

pub(crate) fn run(args: &Args) -> Result<()> {
    let (cell, rust) = cells(&args.folder, &args.meshes, &args.cell)?;
    let joints = rust.robot().independent_joint_names().len();
    let chunks = read_chunks(args, &rust, joints)?;
    let deadline = args.deadline.map(|micros| micros * 1e-6);
    let settings = RccdSettings {
        deadline: deadline.unwrap_or(f64::INFINITY),
        ..default_settings()
    };
    let mut solvers = Vec::new();
    for _ in 0..args.threads.max(1) {
        let solver = Solver(cell_solver(&cell, &default_settings())?);
        check_chunks(&solver, &chunks, joints, (WARM_UP_SEED, args.warm_up), None)?;
        // SAFETY: the handle and the settings live here.
        check(unsafe { rccd_cell_solver_set_settings(solver.0.0, &settings) })?;
        solvers.push(solver);
    }
    let fraction = args.chunks / solvers.len();
    let chunks = &chunks;
    let work = solvers.into_iter().enumerate().map(|(number, solver)| {
        move || check_chunks(&solver, chunks, joints, (number as u64, fraction), deadline)
    });
    let tallies = on_threads(work)?;
    let limit = args
        .deadline
        .map_or("no deadline".to_owned(), |micros| format!("{micros} µs"));
    report(&format!("cell {}, {limit}", args.cell), &tallies);
    Ok(())
}

/// A solver on its way to its thread.
struct Solver(Handle<RccdCellSolver>);

// SAFETY: a solver may be used by one thread at a time, whichever it is.
unsafe impl Send for Solver {}

/// Reads the chunks, and finds out where each one first touches.
fn read_chunks(args: &Args, cell: &Cell, joints: usize) -> Result<Vec<Chunk>> {
    let numbers = read_numbers(&args.folder.join(format!("chunks_{}.bin", args.cell)))?;
    let mut solver = cell.solver().with_settings(rust_settings(1e-9));
    let chunks = numbers.chunks_exact(WAYPOINTS * joints).map(|positions| {
        let path: Vec<&[f64]> = positions.chunks_exact(joints).collect();
        let contact = solver.first_contact(&path)?.contact()?;
        let touches_at = contact.map_or(f64::INFINITY, |contact| contact.at.time());
        let positions = positions.to_vec();
        Ok(Chunk {
            positions,
            touches_at,
        })
    });
    chunks.collect()
}

fn ask(
    solver: &Handle<RccdCellSolver>,
    positions: &[f64],
    joints: usize,
) -> Result<RccdPathAnswer> {
    let path = RccdPath {
        configurations: positions.as_ptr(),
        configuration_count: positions.len() / joints,
        curve: null(),
    };
    let mut answer = empty_path_answer();
    // SAFETY: the pointers are to values that live here.
    check(unsafe { rccd_cell_first_contact(solver.0, &path, &mut answer) })?;
    Ok(answer)
}

/// Checks parts of chunks: from a waypoint before the first contact to a later one.
fn check_chunks(
    solver: &Solver,
    chunks: &[Chunk],
    joints: usize,
    (seed, count): (u64, usize),
    deadline: Option<f64>,
) -> Result<Tally> {
    let mut tally = Tally::new(deadline, count);
    let mut random = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1;
    let mut below = |limit: usize| {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) as usize % limit
    };
    let mut failure = None;
    let counted = allocation_counter::measure(|| {
        for _ in 0..count {
            let chunk = &chunks[below(chunks.len())];
            let first = below((lesser(chunk.touches_at, (WAYPOINTS - 2) as f64) as usize).max(1));
            let waypoints = (16 + below(WAYPOINTS - 15)).min(WAYPOINTS - first);
            let part = &chunk.positions[first * joints..(first + waypoints) * joints];
            match tally.ask(|| ask(&solver.0, part, joints)) {
                Ok(answer) => {
                    let answer = Answered {
                        outcome: answer.outcome,
                        free_until: answer.segment as f64 + answer.fraction,
                        end: (waypoints - 1) as f64,
                    };
                    tally.judge(answer, chunk.touches_at - first as f64);
                }
                Err(error) => failure = Some(error),
            }
        }
    });
    tally.allocations = counted.count_total;
    failure.map_or(Ok(tally), Err)
}
