//! Answers a table of motions with the library alone, to measure the cost without tables of results.
//!
//! ```sh
//! cargo run --release -p rigid-ccd --example rows -- A.obj B.obj motions.csv [THREADS [ROWS [TIMES]]]
//! ```
//! The rows are repeated until there are `ROWS`. It prints the seconds that `ParallelSolver::first_contacts` takes, and
//! writes the time of each row to the file `TIMES`, as f64 in little-endian order: those of rows without a contact are
//! their durations. Without arguments it shows a small table of its own.

use anyhow::{Context, Result};
use rigid_ccd::table::motions::{MotionTable, Motions};
use rigid_ccd::{Body, ParallelSolver, Solver, load};
use std::fs::{self, File};
use std::io::Write;
use std::num::NonZeroUsize;
use std::time::Instant;

const SHOWN: &str = "id,a_px,a_vx\nslow,-3,1\nfast,-3,4\n";

fn main() -> Result<()> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let number = |k: usize, default| args.get(k).map_or(Ok(default), |text| text.parse());
    let (a, b, table) = match args.get(..3) {
        Some([a, b, motions]) => (
            load(a)?,
            load(b)?,
            MotionTable::read(File::open(motions).context(motions.clone())?)?,
        ),
        _ => {
            let (ball, wall) = (Body::sphere(0.5)?, Body::cuboid([0.1, 5.0, 5.0])?);
            (ball, wall, MotionTable::read(SHOWN.as_bytes())?)
        }
    };
    let queries: Vec<Motions> = table.rows.into_iter().map(|(_, query)| query).collect();
    let rows = number(4, queries.len())?;
    let queries: Vec<_> = (queries.iter().cycle().take(rows))
        .map(|query| ((&a, query.a), (&b, query.b), query.duration))
        .collect();
    let threads = NonZeroUsize::new(number(3, 1)?).context("at least one thread")?;
    let mut solver = ParallelSolver::with_threads(threads, Solver::new);

    let begin = Instant::now();
    let found = solver.first_contacts(&queries);
    let seconds = begin.elapsed().as_secs_f64();
    let mut times = Vec::new();
    for (found, query) in found.into_iter().zip(&queries) {
        let time = found?.hit()?.map_or(query.2, |hit| hit.time);
        times.extend(time.to_le_bytes());
    }
    writeln!(
        std::io::stdout(),
        "{rows} rows, {threads} threads: {seconds:.3} s"
    )?;
    match args.get(5) {
        Some(path) => fs::write(path, &times).context(path.clone()),
        None => Ok(()),
    }
}
