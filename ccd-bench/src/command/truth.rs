//! The command `ccd-bench truth`: reads two meshes and a table of motions, and writes a table of
//! brackets of the exact first contacts.

use crate::names::name_of;
use crate::truth::{Referee, Status, Surface, TRUTH_COLUMNS, TruthRow};
use anyhow::{Context, Result};
use ccd_core::order::greater;
use ccd_decomp::TriangleMesh;
use clap::{Args, ValueEnum};
use rigid_ccd::ParallelSolver;
use rigid_ccd::batch::{BatchSize, on_threads};
use rigid_ccd::command::{
    BadRows, Exit, Progress, Size, Table, complain, input_name, open_motions, refuse_overwriting,
    same_file,
};
use rigid_ccd::table::motions::MotionRow;
use std::collections::HashMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Bracket the exact first contacts of two meshes, to judge answers by
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP, after_long_help = AFTER_LONG_HELP)]
pub(super) struct TruthArgs {
    /// Body A: a mesh, .obj, .stl, .ply or .off
    #[arg(long, value_name = "MESH")]
    a: PathBuf,
    /// Body B, as body A; the same file is loaded once
    #[arg(long, value_name = "MESH")]
    b: PathBuf,
    /// The table of motions, CSV, in the format of `ccd query`; - reads standard input
    #[arg(long, value_name = "CSV")]
    motions: PathBuf,
    /// Threads to work on; the brackets do not depend on their number [default: all there are]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// The table of truths, CSV; - writes to standard output
    #[arg(long, value_name = "CSV", default_value = "-")]
    out: PathBuf,
    /// Print only errors on standard error
    #[arg(long, short)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
Examples:
  ccd-bench truth --a knot.obj --b knot.obj --motions motions.csv --out truth.csv
  printf 'a_pz,a_vz\\n3,-4\\n' | ccd-bench truth --a part.stl --b slab.obj --motions -

See `ccd-bench truth --help` for the columns of the table and the exit code.";

const AFTER_LONG_HELP: &str = "\
The bodies are surfaces: a body inside another is apart from it. The method is
independent of those of `ccd query`, and made to be right, not fast: bisection in time, each step
certified against rounding.

Table of truths:
  id        as in the table of motions (see `ccd query --help` for its columns)
  status    hit        the first contact is not before lo and not after hi, usually 1e-13 apart
            free       apart for the whole duration; lo and hi are the duration
            initial    they touch at the start, or nearly so; lo and hi are 0
            graze      apart before lo, in contact or nearly so at lo, never shown to intersect
            undecided  apart before lo, unknown after it: the work limit of a row was reached
            error      the row is no valid query
  reason    the problem of a row of status error

Rows are written in order as they are judged, to a file that ends in .partial until all rows are judged.

Exit code: 0 if every row is judged, 2 if there are rows of status error or other invalid input, 1 if
the table cannot be written.

Examples:
  ccd-bench truth --a knot.obj --b knot.obj --motions motions.csv --out truth.csv
  ccd-bench truth --a part.stl --b part.stl --motions motions.csv --threads 1 --out truth.csv
  printf 'a_pz,a_vz\\n3,-4\\n' | ccd-bench truth --a part.stl --b slab.obj --motions -";

/// Brackets the first contact of all valid rows; the table gives the reason for the others.
pub(super) fn run(args: &TruthArgs) -> Result<Exit> {
    for (option, path) in [
        ("--motions", &args.motions),
        ("--a", &args.a),
        ("--b", &args.b),
    ] {
        refuse_overwriting((option, path), ("--out", &args.out))?;
    }
    let (mut rows, length) = open_motions(&args.motions)?;
    let (a, b) = load(args)?;
    let referee = Referee::new(&a, b.as_ref().unwrap_or(&a));
    let mut table = Table::create(&args.out, &TRUTH_COLUMNS)?;
    // A referee has no scratch memory, so that all threads share one.
    let mut referees = on_threads(args.threads, || &referee);
    let mut size = BatchSize::new(referees.threads());
    let progress = Progress::of_rows(length, args.quiet);
    let mut bad_rows = BadRows::new(input_name(&args.motions));
    let (mut counts, mut widest) = (HashMap::new(), 0.0);
    let start = Instant::now();
    loop {
        let batch: Result<Vec<MotionRow>, _> = rows.by_ref().take(size.items()).collect();
        let batch = batch.with_context(|| input_name(&args.motions))?;
        if batch.is_empty() {
            break;
        }
        progress.answering(batch.len(), rows.bytes());
        let started = Instant::now();
        let truths = judge(&mut referees, &batch, &progress);
        size.adapt(started.elapsed());
        for (row, truth) in batch.iter().zip(truths) {
            match (row, truth) {
                (Ok(_), Some(truth)) => {
                    *counts.entry(truth.status).or_default() += 1;
                    widest = greater(widest, truth.width());
                    table.write(|writer| writer.serialize((truth, "")))?;
                }
                (Ok(_), None) => {}
                (Err(error), _) => {
                    bad_rows.report(error.position, &error.problem, &progress);
                    let reason = error.problem.to_string();
                    table.write(|writer| writer.serialize((&error.id, "error", "", "", reason)))?;
                }
            }
        }
        table.flush()?;
    }
    table.finish()?;
    drop(progress);
    bad_rows.close();
    if counts.is_empty() && bad_rows.count() == 0 {
        complain(&format!(
            "{}: has a header, but no rows",
            input_name(&args.motions)
        ));
    }
    if !args.quiet {
        let seconds = start.elapsed().as_secs_f64();
        let _ = writeln!(io::stderr(), "{}, {seconds:.1} s", summary(&counts, widest));
    }
    Ok(match bad_rows.count() {
        0 => Exit::AllAnswered,
        _ => Exit::SomeRowsBad,
    })
}

/// Reads the surfaces of both bodies; B is `None` if it comes from the same file as A.
fn load(args: &TruthArgs) -> Result<(Surface, Option<Surface>)> {
    let surface = |option: &str, path: &Path| -> Result<(Surface, Size)> {
        let progress = Progress::of(&format!("reading {}", path.display()), args.quiet);
        let mesh = TriangleMesh::read(path).with_context(|| option.to_owned())?;
        let surface = Surface::new(&mesh);
        drop(progress);
        Ok((surface, Size::of_points(mesh.vertices().iter().copied())))
    };
    let (a, size_a) = surface("--a", &args.a)?;
    if same_file(&args.a, &args.b) {
        return Ok((a, None));
    }
    let (b, size_b) = surface("--b", &args.b)?;
    if !args.quiet {
        Size::compare(size_a, size_b);
    }
    Ok((a, Some(b)))
}

/// Returns the truth of every row; `None` for rows that are not valid.
fn judge(
    referees: &mut ParallelSolver<&Referee<'_>>,
    batch: &[MotionRow],
    progress: &Progress,
) -> Vec<Option<TruthRow>> {
    referees.map(batch, |referee, row| {
        let truth = row.as_ref().ok().map(|(_, query)| {
            let truth = referee.first_contact(query);
            TruthRow::new(query.id.clone(), query.duration, truth)
        });
        progress.step();
        truth
    })
}

/// Describes how many rows have each kind of truth, and the widest bracket of a first contact.
fn summary(counts: &HashMap<Status, usize>, widest: f64) -> String {
    let kinds = Status::value_variants().iter().map(|kind| {
        let count = counts.get(kind).unwrap_or(&0);
        format!("{count} {}", name_of(kind))
    });
    let (rows, kinds): (usize, Vec<String>) = (counts.values().sum(), kinds.collect());
    format!(
        "{rows} rows: {}; widest bracket {widest:.1e}",
        kinds.join(", ")
    )
}
