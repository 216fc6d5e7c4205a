//! Breaks the engine, if it can be broken: queries drawn from families of hard cases, each answered by
//! many methods, judged by a referee in numbers of twice the digits of f64.
//!
//! ```sh
//! cargo run --release -p ccd-tests --example fuzz -- --family needles --queries 100000 --seed 1
//! ```
//! Nothing here is shared with the engine, its property suite or its other referees, but the public
//! interface that is asked: generators, arithmetic and verdicts are of their own. What fails is printed
//! with its files and command line; `--only N` asks one query again. Exit code 1 if anything failed.
#![allow(
    missing_docs,
    unreachable_pub,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program, not a library"
)]

mod case;
mod course;
mod double;
mod draw;
mod engine;
mod families;
mod nearest;
mod referee;
mod shapes;
mod solid;
mod tally;
mod trial;
mod vector;
mod verdict;

use clap::{Parser, ValueEnum};
use families::Family;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use std::process::ExitCode;
use std::sync::Mutex;
use tally::Tally;
use trial::Watch;

/// Random queries from families of hard cases, judged in double-double.
#[derive(Parser)]
struct Args {
    /// Which kind of hard cases; all, one after another, if none is given
    #[arg(long, value_enum)]
    family: Option<Family>,
    /// How many queries of each family
    #[arg(long, default_value_t = 1000)]
    queries: u64,
    /// Another seed draws other queries
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// On how many threads; 0 for all cores
    #[arg(long, default_value_t = 0)]
    threads: usize,
    /// Only the query of this number
    #[arg(long)]
    only: Option<u64>,
    /// Drop triangles of what failed for as long as it fails
    #[arg(long)]
    shrink: bool,
    /// How many failures of a kind to print
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

/// Whether anything failed.
fn run(family: Family, args: &Args) -> bool {
    let numbers = match args.only {
        Some(one) => one..one + 1,
        None => 0..args.queries,
    };
    let asked = numbers.end - numbers.start;
    let style = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} {eta}");
    let bar = ProgressBar::new(asked).with_message(format!("{family:?}"));
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    let tally = Mutex::new(Tally::default());
    let watch = Watch::start(family, args.seed);
    numbers.into_par_iter().for_each(|number| {
        let trial = trial::run(family, args.seed, number, &watch);
        if args.only.is_some() {
            bar.suspend(|| println!("{trial}"));
        }
        if let Ok(mut tally) = tally.lock() {
            for failure in tally.add(number, &trial, args.print) {
                let case = match args.shrink {
                    true => trial::shrunk(&trial.case, failure),
                    false => trial.case.clone(),
                };
                bar.suspend(|| println!("{}", failure.report(family, args.seed, number, &case)));
            }
        }
        bar.inc(1);
    });
    bar.finish_and_clear();
    let tally = tally.into_inner().unwrap_or_default();
    println!("{family:?}, seed {}: {tally}", args.seed);
    if asked >= 1000 {
        tally.assert_representative();
    }
    tally.failed()
}
