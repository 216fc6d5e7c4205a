//! Queries per second on one thread and on more.
//!
//! Calls `ParallelSolver::map` on each number of threads in turn, round by round, and times these calls
//! alone. All answers must be the same bits. On a machine with other work, compare with two processes of
//! one thread each, at the same time and on different cores: they share nothing but the machine.
//!
//! ```sh
//! cargo run --release -p ccd-bench --example threads -- A.obj B.obj motions.csv [THREADS [ROUNDS]]
//! ```

use anyhow::{Context, bail, ensure};
use rigid_ccd::batch::median;
use rigid_ccd::table::motions::{MotionTable, Motions};
use rigid_ccd::{Answer, Body, InputError, ParallelSolver, Solver, load};
use std::fs::File;
use std::io::Write;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

/// The approximate duration of a call on one thread.
const CALL: Duration = Duration::from_millis(500);

fn main() -> anyhow::Result<()> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [a, b, motions, counts @ ..] = &args[..] else {
        bail!("give A.obj B.obj motions.csv [THREADS [ROUNDS]]");
    };
    let count = |index: usize, default: usize| match counts.get(index) {
        Some(text) => text.parse().map(NonZeroUsize::get),
        None => Ok(default),
    };
    let (threads, rounds) = (count(0, 2)?, count(1, 9)?);
    let bodies = (&load(a)?, &load(b)?);
    let table = MotionTable::read(File::open(motions).context("motions")?)?;
    ensure!(table.errors.is_empty(), "the table has bad rows");
    let once: Vec<&Motions> = table.rows.iter().map(|(_, query)| query).collect();
    let mut solvers: Vec<ParallelSolver> = (1..=threads)
        .filter_map(NonZeroUsize::new)
        .map(|threads| ParallelSolver::with_threads(threads, Solver::new))
        .collect();
    let (taken, expected) = answer(&mut solvers[0], bodies, &once)?;
    let queries = once.repeat(1 + CALL.div_duration_f64(taken) as usize);
    let mut rates = vec![Vec::new(); threads];
    for _ in 0..rounds {
        for (solver, rates) in solvers.iter_mut().zip(&mut rates) {
            let (taken, answers) = answer(solver, bodies, &queries)?;
            let same = answers.chunks(once.len()).all(|part| part == expected);
            ensure!(same, "other answers on {} threads", solver.threads());
            rates.push(queries.len() as f64 / taken.as_secs_f64());
        }
    }
    print(queries.len(), rates)
}

/// Answers all queries, and returns the duration.
fn answer(
    solver: &mut ParallelSolver,
    (a, b): (&Body, &Body),
    queries: &[&Motions],
) -> Result<(Duration, Vec<Answer>), InputError> {
    let start = Instant::now();
    let answers = solver.map(queries, |solver, query| {
        solver.first_contact((a, query.a), (b, query.b), query.duration)
    });
    let taken = start.elapsed();
    Ok((taken, answers.into_iter().collect::<Result<_, _>>()?))
}

/// Prints the rates for each number of threads, the best and the median of all rounds, and their ratios to those of one
/// thread.
fn print(queries: usize, mut rates: Vec<Vec<f64>>) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{queries} queries a call")?;
    writeln!(out, "threads,best,median,ratio of best,median ratio")?;
    let mut one = rates[0].clone();
    let mut ratios: Vec<Vec<f64>> = Vec::new();
    for many in &rates {
        ratios.push(
            many.iter()
                .zip(&one)
                .map(|(many, one)| many / one)
                .collect(),
        );
    }
    let middle_and_best = |rates: &mut Vec<f64>| (median(rates), rates[rates.len() - 1]);
    let (_, best_of_one) = middle_and_best(&mut one);
    for (index, (rates, ratios)) in rates.iter_mut().zip(&mut ratios).enumerate() {
        let (middle, best) = middle_and_best(rates);
        let (threads, of_best) = (index + 1, best / best_of_one);
        let ratio = median(ratios);
        writeln!(
            out,
            "{threads},{best:.0},{middle:.0},{of_best:.3},{ratio:.3}"
        )?;
    }
    Ok(())
}
