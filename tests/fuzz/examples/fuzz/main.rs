//! Tries to break the engine by random queries. They are drawn from families of hard cases, answered by many methods,
//! and judged by a referee in double-double numbers.
//!
//! ```sh
//! cargo run --release -p ccd-fuzz --example fuzz -- --family needles --queries 100000 --seed 1
//! ```
//! Failures are printed with their files and command line; `--only N` runs one query again. The exit code
//! is 1 if anything failed.
#![allow(
    missing_docs,
    unreachable_pub,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program, not a library"
)]

mod draw;
mod families;
mod shapes;
mod tally;
mod trial;

use ccd_fuzz::targets::encode;
use ccd_fuzz::{case, engine, judge, raw_motion, vector};
use clap::{Parser, ValueEnum};
use families::Family;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use tally::Tally;
use trial::{Trial, Watchdog};

/// Random queries from families of hard cases, judged in double-double.
#[derive(Parser)]
struct Args {
    /// The family of hard cases; all, one after another, if none is given
    #[arg(long, value_enum)]
    family: Option<Family>,
    /// The number of queries of each family
    #[arg(long, default_value_t = 1000)]
    queries: u64,
    /// The random seed
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The number of threads; 0 for all cores
    #[arg(long, default_value_t = 0)]
    threads: usize,
    /// Only the query with this number
    #[arg(long)]
    only: Option<u64>,
    /// Drop triangles of a failed case for as long as it fails
    #[arg(long)]
    shrink: bool,
    /// A folder to write the queries to, as seeds of the fuzz target `query`; those too large for it are left out
    #[arg(long)]
    seeds: Option<PathBuf>,
    /// The number of failures of a kind to print
    #[arg(long, default_value_t = 2)]
    print: usize,
}

fn main() -> ExitCode {
    let args = Args::parse();
    let threads = rayon::ThreadPoolBuilder::new()
        .num_threads(args.threads)
        .build_global();
    if let Err(error) = threads {
        eprintln!("{error}");
        return ExitCode::FAILURE;
    }
    // Panics of the engine are caught and counted.
    std::panic::set_hook(Box::new(|_| {}));
    let families = args
        .family
        .map_or(Family::value_variants().to_vec(), |one| vec![one]);
    let failed = families
        .into_iter()
        .filter(|&family| run(family, &args))
        .count();
    if failed == 0 {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// Runs all queries of a family. Returns true if any answer was wrong.
fn run(family: Family, args: &Args) -> bool {
    let numbers = match args.only {
        Some(one) => one..one + 1,
        None => 0..args.queries,
    };
    let asked = numbers.end - numbers.start;
    let tally = Mutex::new(Tally::default());
    let watch = Watchdog::start(family, args.seed);
    numbers.into_par_iter().for_each(|number| {
        let trial = trial::run(family, args.seed, number, &watch);
        if let Some(folder) = &args.seeds
            && let Err(error) = write_seed(folder, family, number, &trial)
        {
            eprintln!("{}: {error}", folder.display());
        }
        if args.only.is_some() {
            println!("{trial}");
        }
        if let Ok(mut tally) = tally.lock() {
            for failure in tally.add(number, &trial, args.print) {
                let case = if args.shrink {
                    trial::shrink(&trial.case, failure)
                } else {
                    trial.case.clone()
                };
                println!(
                    "{}",
                    trial::report(failure, family, args.seed, number, &case)
                );
            }
        }
    });
    let tally = tally.into_inner().unwrap_or_default();
    println!("{family:?}, seed {}: {tally}", args.seed);
    if asked >= 1000 {
        tally.assert_representative();
    }
    tally.has_failures()
}

/// Writes the query of a trial as a seed of the fuzz target `query`; `number` chooses the method that answers it.
fn write_seed(folder: &Path, family: Family, number: u64, trial: &Trial) -> io::Result<()> {
    match encode(&trial.case, (number % 15) as u8) {
        Some(bytes) => fs::write(
            folder.join(format!("{family:?}-{number}").to_lowercase()),
            bytes,
        ),
        None => Ok(()),
    }
}
