//! Answers millions of mixed queries in one process from all threads, and watches memory, speed and answers.
//!
//! ```sh
//! cargo run --release -p ccd-tests --example load -- --queries 10000000
//! ```
//! The exit code is 1 if an answer was late, missed or false, if the memory grew by more than a twentieth after
//! the first tenth, or if the last tenth took longer than the first by as much as the machine's noise allows.
#![allow(
    missing_docs,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program, not a library"
)]

use ccd_bench::method::solver::Claim;
use ccd_bench::run::contest::{self, Verdict};
use ccd_bench::truth::{Referee, Surface};
use ccd_tests::mixed::Mixed;
use ccd_tests::models::{Kind, icosphere};
use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use rigid_ccd::glam::DVec3;
use rigid_ccd::table::motions::Query;
use rigid_ccd::{Answer, Config, Motion, Outcome, Pose, Solver, StartPolicy};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::collections::BTreeMap;
use std::process::ExitCode;
use std::time::Instant;
use std::{fs, thread};

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Millions of mixed queries in one process.
#[derive(Parser)]
struct Args {
    /// The number of queries
    #[arg(long, default_value_t = 1_000_000)]
    queries: u64,
    /// One in this many answers is held against the referee
    #[arg(long, default_value_t = 100)]
    judged: u64,
    /// The number of threads; 0 for all cores
    #[arg(long, default_value_t = 0)]
    threads: u64,
}

/// The parts of the run, after each of which memory and time are read.
const PARTS: u64 = 10;

/// The growth of the memory after the first part, and of the time of a part, that counts as none.
const MEMORY: f64 = 1.05;
const TIME: f64 = 1.3;

/// The answers of a thread.
struct Answers {
    /// By outcome.
    counts: BTreeMap<String, u64>,
    /// Those that the referee will see, with room for all of them from the start: memory must not grow.
    judged: Vec<Option<(u64, Claim)>>,
    next: usize,
}

impl Answers {
    fn new(args: &Args, threads: u64) -> Self {
        let room = args.queries / (args.judged * threads) + args.judged + 1;
        Answers {
            counts: BTreeMap::new(),
            judged: vec![None; room as usize],
            next: 0,
        }
    }

    fn add(&mut self, number: u64, answer: &Answer, is_judged: bool) {
        let (name, claim) = match &answer.outcome {
            &Outcome::Contact { time, .. } => ("contact", Claim::Contact { time }),
            Outcome::Free { .. } => ("free", Claim::Free),
            Outcome::Touching { .. } => ("touching", Claim::Contact { time: 0.0 }),
            Outcome::Overlapping { .. } => ("overlapping", Claim::Contact { time: 0.0 }),
            &Outcome::Unresolved { safe_until, .. } => {
                ("unresolved", Claim::Unresolved { safe_until })
            }
        };
        match self.counts.get_mut(name) {
            Some(count) => *count += 1,
            None => {
                self.counts.insert(name.to_owned(), 1);
            }
        }
        if let Outcome::Unresolved { reason, .. } = &answer.outcome {
            *self
                .counts
                .entry(format!("of these by: {reason}"))
                .or_default() += 1;
        }
        if let (true, Some(place)) = (is_judged, self.judged.get_mut(self.next)) {
            *place = Some((number, claim));
            self.next += 1;
        }
    }
}

fn main() -> ExitCode {
    let args = Args::parse();
    let cores = thread::available_parallelism().map_or(1, |cores| cores.get() as u64);
    let threads = if args.threads == 0 {
        cores
    } else {
        args.threads
    };
    let mixed = Mixed::new();
    let mut workers: Vec<(Solver, Answers)> = (0..threads)
        .map(|_| (warm_solver(), Answers::new(&args, threads)))
        .collect();
    let bar = progress(args.queries);
    let mut parts = Vec::new();
    println!("part  seconds  queries/s  resident MB  heap MB  allocations a query");
    for part in 0..PARTS {
        let numbers = part * args.queries / PARTS..(part + 1) * args.queries / PARTS;
        let asked = (numbers.end - numbers.start) as f64;
        let (start, region) = (Instant::now(), Region::new(HEAP));
        thread::scope(|scope| {
            for (worker, first) in workers.iter_mut().zip(numbers.start..) {
                let own = (first..numbers.end).step_by(threads as usize);
                let (mixed, bar) = (&mixed, &bar);
                scope.spawn(move || answer_all(mixed, own, args.judged, worker, bar));
            }
        });
        let seconds = start.elapsed().as_secs_f64();
        let (change, all) = (region.change(), HEAP.stats());
        let (resident, heap) = (
            resident_megabytes(),
            (all.bytes_allocated - all.bytes_deallocated) as f64 / f64::from(1 << 20),
        );
        let allocations = (change.allocations + change.reallocations) as f64 / asked;
        let rate = asked / seconds;
        bar.suspend(|| {
            println!(
                "{part:4}  {seconds:7.1}  {rate:9.0}  {resident:11.2}  {heap:7.2}  {allocations:.6}"
            );
        });
        parts.push((seconds, resident, heap));
    }
    bar.finish_and_clear();
    let answers: Vec<Answers> = workers.into_iter().map(|(_, answers)| answers).collect();
    let mut counts: BTreeMap<&str, u64> = BTreeMap::new();
    for (name, count) in answers.iter().flat_map(|answers| &answers.counts) {
        *counts.entry(name).or_default() += count;
    }
    println!("{counts:?}");
    let right = judge(&mixed, &answers);
    let (first, last) = (parts[0], parts[parts.len() - 1]);
    let flat = last.0 <= TIME * first.0 && last.1 <= MEMORY * first.1 && last.2 <= MEMORY * first.2;
    if !flat {
        println!(
            "not flat, in seconds, resident MB and heap MB: {first:?} at first, {last:?} at last"
        );
    }
    if right && flat {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// Makes a solver that holds as much memory as it ever keeps: one ball turns in another, and none of their
/// many pairs of triangles stays apart for good.
fn warm_solver() -> Solver {
    let [inner, outer] = [0.6, 0.6003].map(|radius| icosphere(radius, 5).body(Kind::Triangles));
    let turns = Motion::new(Pose::IDENTITY, DVec3::ZERO, DVec3::Z).expect("finite");
    let config = Config {
        tolerance: 1e-5,
        ..Config::default()
    };
    let mut solver = Solver::new().with_config(config);
    let answer = solver.answer((&inner, turns), (&outer, Motion::STILL), 1.0);
    println!("warm after {:?}", answer.expect("a well-posed query").stats);
    solver
}

fn progress(queries: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} {eta}");
    let bar = ProgressBar::new(queries);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}

fn answer_all(
    mixed: &Mixed,
    numbers: impl Iterator<Item = u64>,
    judged: u64,
    (solver, answers): &mut (Solver, Answers),
    bar: &ProgressBar,
) {
    for number in numbers {
        let posed = mixed.posed(number);
        let [a, b] = [0, 1].map(|k| mixed.moving(&posed, k));
        solver.set_config(posed.config);
        let answer = solver.answer(a, b, 1.0).expect("a well-posed query");
        // The referee keeps no distance, and lets no bodies go.
        let config = posed.config;
        let can_be = config.margin == 0.0 && config.start == StartPolicy::Report;
        answers.add(number, &answer, can_be && number.is_multiple_of(judged));
        if number.is_multiple_of(1_000) {
            bar.inc(1_000);
        }
    }
}

/// Holds answers against the referee, and returns whether none is wrong.
fn judge(mixed: &Mixed, answers: &[Answers]) -> bool {
    let surfaces: Vec<Surface> = mixed.meshes().iter().map(Surface::new).collect();
    let asked: Vec<(u64, Claim)> = answers
        .iter()
        .flat_map(|answers| answers.judged.iter().flatten().copied())
        .collect();
    let verdicts: Vec<(u64, Verdict)> = asked
        .par_iter()
        .map(|&(number, claim)| {
            let posed = mixed.posed(number);
            let [a, b] = posed.bodies.map(|body| &surfaces[body]);
            let [motion_a, motion_b] = posed.motions;
            let query = Query {
                id: number.to_string(),
                a: motion_a,
                b: motion_b,
                duration: 1.0,
            };
            let referee = Referee::new(a, b);
            let truth = referee.first_contact(&query);
            let judged = contest::judge(&referee, &query, truth, claim, posed.config.tolerance);
            (number, judged.verdict)
        })
        .collect();
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    let mut right = true;
    for (number, verdict) in verdicts {
        *counts.entry(verdict.to_string()).or_default() += 1;
        if matches!(
            verdict,
            Verdict::Late | Verdict::Missed | Verdict::False | Verdict::Early
        ) {
            println!("{verdict}: query {number}");
            right = false;
        }
    }
    println!("judged: {counts:?}");
    right
}

/// Returns the memory of the process that is in the machine's; 0 where that is not told.
fn resident_megabytes() -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let kilobytes = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok());
    kilobytes.unwrap_or(0.0) / 1024.0
}
