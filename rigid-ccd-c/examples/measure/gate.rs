//! Checks chunks of waypoints under a deadline on several threads: allocations, times, and prefixes against the truth.

use crate::folder::{
    Handle, cell_solver, cells, check, default_settings, empty_path_answer, read_numbers,
    rust_settings,
};
use anyhow::Result;
use ccd_core::order::lesser;
use rigid_ccd_c::*;
use rigid_ccd_robot::{Cell, PathOutcome};
use rustix::time::{ClockId, clock_gettime};
use std::path::PathBuf;
use std::ptr::null;
use std::time::Instant;

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

/// What a thread has seen.
#[derive(Default)]
struct Seen {
    /// Seconds of the clock, and of the processor, for each chunk.
    times: Vec<[f32; 2]>,
    allocations: u64,
    free: usize,
    contacts: usize,
    unresolved: usize,
    prefixes: usize,
    /// Answers that came although the deadline had passed by 20 µs of the processor's time: of these, contacts and free paths.
    late: [usize; 2],
    /// Prefixes that go beyond the first contact, and other wrong answers.
    wrong: usize,
}

pub(crate) fn run(args: &Args) -> Result<()> {
    let (cell, rust) = cells(&args.folder, &args.meshes, &args.cell)?;
    let joints = rust.robot().free_joint_names().len();
    let chunks = read_chunks(args, &rust, joints)?;
    let settings = RccdSettings {
        deadline: args.deadline.map_or(f64::INFINITY, |micros| micros * 1e-6),
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
    let share = args.chunks / solvers.len();
    let latest = args.deadline.map(|micros| ((micros + 20.0) * 1e-6) as f32);
    let seen = std::thread::scope(|scope| {
        let threads = solvers.into_iter().enumerate().map(|(number, solver)| {
            let chunks = &chunks;
            scope.spawn(move || {
                check_chunks(&solver, chunks, joints, (number as u64, share), latest)
            })
        });
        let threads: Vec<_> = threads.collect();
        let seen = threads.into_iter().map(|thread| thread.join());
        seen.collect::<Result<Vec<_>, _>>()
    });
    let seen = seen.map_err(|_| anyhow::anyhow!("a thread has panicked"))?;
    report(args, seen.into_iter().collect::<Result<_>>()?);
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
        let touches_at = match solver.first_contact(&path)? {
            PathOutcome::Free => f64::INFINITY,
            PathOutcome::Contact(contact) => contact.at.time(),
            PathOutcome::Unresolved { limit, .. } => anyhow::bail!("{limit}"),
        };
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
    latest: Option<f32>,
) -> Result<Seen> {
    let mut seen = Seen {
        times: Vec::with_capacity(count),
        ..Seen::default()
    };
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
            let (start, worked) = (Instant::now(), processor_seconds());
            let answer = ask(&solver.0, part, joints);
            let times = [
                start.elapsed().as_secs_f32(),
                (processor_seconds() - worked) as f32,
            ];
            seen.times.push(times);
            if let (Ok(answer), Some(latest)) = (&answer, latest)
                && times[1] > latest
            {
                let is_resolved = answer.outcome != RccdOutcome::Unresolved;
                seen.late[usize::from(is_resolved)] += 1;
            }
            match answer {
                Ok(answer) => seen.judge(&answer, chunk.touches_at - first as f64, waypoints),
                Err(error) => failure = Some(error),
            }
        }
    });
    seen.allocations = counted.count_total;
    failure.map_or(Ok(seen), Err)
}

/// Returns the time that this thread has been running.
fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

impl Seen {
    /// Holds an answer against where the part of the chunk first touches.
    fn judge(&mut self, answer: &RccdPathAnswer, touches_at: f64, waypoints: usize) {
        let end = (waypoints - 1) as f64;
        let at = answer.segment as f64 + answer.share;
        let right = match answer.outcome {
            RccdOutcome::Free => {
                self.free += 1;
                touches_at >= end
            }
            RccdOutcome::Contact => {
                self.contacts += 1;
                at <= touches_at
            }
            _ => {
                self.unresolved += 1;
                self.prefixes += usize::from(at > 0.0);
                at <= touches_at
            }
        };
        self.wrong += usize::from(!right);
    }
}

fn report(args: &Args, seen: Vec<Seen>) {
    let sum = |count: fn(&Seen) -> usize| seen.iter().map(count).sum::<usize>();
    let allocations: u64 = seen.iter().map(|seen| seen.allocations).sum();
    println!(
        "cell {}, deadline {}, {} threads: {} chunks, {} free, {} in contact, {} unresolved ({} with a free prefix), {} wrong; \
         {allocations} allocations",
        args.cell,
        args.deadline
            .map_or("none".to_owned(), |micros| format!("{micros} µs")),
        seen.len(),
        sum(|seen| seen.times.len()),
        sum(|seen| seen.free),
        sum(|seen| seen.contacts),
        sum(|seen| seen.unresolved),
        sum(|seen| seen.prefixes),
        sum(|seen| seen.wrong),
    );
    let late = [0, 1].map(|kind| seen.iter().map(|seen| seen.late[kind]).sum::<usize>());
    if args.deadline.is_some() {
        println!(
            "  later than 20 µs: {} unresolved, {} resolved",
            late[0], late[1]
        );
    }
    for (which, name) in ["of the clock", "of the processor"].into_iter().enumerate() {
        let mut micros: Vec<f32> = seen
            .iter()
            .flat_map(|seen| seen.times.iter().map(|times| 1e6 * times[which]))
            .collect();
        micros.sort_by(f32::total_cmp);
        let Some(last) = micros.len().checked_sub(1) else {
            return;
        };
        let at = |share: f64| micros[(share * last as f64) as usize];
        let late = args.deadline.map(|deadline| {
            let beyond = |by: f64| {
                let count = micros.partition_point(|&own| f64::from(own) <= deadline + by);
                micros.len() - count
            };
            format!(
                "; beyond the deadline by 5 µs: {}, 20 µs: {}, 100 µs: {}",
                beyond(5.0),
                beyond(20.0),
                beyond(100.0)
            )
        });
        println!(
            "  microseconds {name}: p50 {:.1}, p99 {:.1}, p99.9 {:.1}, p99.99 {:.1}, max {:.1}{}",
            at(0.5),
            at(0.99),
            at(0.999),
            at(0.9999),
            micros[last],
            late.unwrap_or_default(),
        );
    }
}
