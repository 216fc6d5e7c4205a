//! The command `ccd-bench truth`: reads two meshes and a table of motions, and writes a table of
//! brackets of the exact first contacts.

use super::inputs::QueryTableArgs;
use crate::truth::{Surface, TRUTH_COLUMNS, TRUTH_STATUSES, TruthRow, TruthSolver};
use anyhow::{Context, Result};
use ccd_core::order::greater;
use ccd_tables::motions::MotionRow;
use clap::Args;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rigid_ccd_cli::{
    BadRowCounter, Progress, RunOutcome, TableWriter, input_name, open_motions, print_error,
    refuse_overwriting_input,
};
use std::collections::HashMap;
use std::io::{self, Write};
use std::path::PathBuf;
use std::time::Instant;

/// Bracket the exact times of first contact of two meshes, as the truth by which answers are judged
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct TruthArgs {
    #[command(flatten)]
    input: QueryTableArgs,
    /// The table of truths, CSV; - writes to standard output
    #[arg(long, value_name = "CSV", default_value = "-")]
    out: PathBuf,
    /// Print only errors on standard error
    #[arg(long, short)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
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
  printf 'a_pz,a_vz\\n3,-4\\n' | ccd-bench truth --a part.stl --b slab.obj --motions -";

/// The number of rows that are judged in parallel before their results are written.
const BATCH_SIZE: usize = 256;

/// Brackets the first contact of every valid row, and writes the problem of every invalid row to the table.
pub(super) fn run(args: &TruthArgs) -> Result<RunOutcome> {
    let input = &args.input;
    for (option, path) in [
        ("--motions", &input.motions),
        ("--a", &input.meshes.a),
        ("--b", &input.meshes.b),
    ] {
        refuse_overwriting_input((option, path), ("--out", &args.out))?;
    }
    let (mut rows, length) = open_motions(&input.motions)?;
    let [a, b] = input.meshes.read_meshes()?.each_ref().map(Surface::new);
    let referee = TruthSolver::new(&a, &b);
    let mut table = TableWriter::create(&args.out, &TRUTH_COLUMNS)?;
    let progress = Progress::for_rows(length, args.quiet);
    let mut bad_rows = BadRowCounter::new(input_name(&input.motions));
    let (mut counts, mut widest) = (HashMap::new(), 0.0);
    let start = Instant::now();
    loop {
        let batch: Result<Vec<MotionRow>, _> = rows.by_ref().take(BATCH_SIZE).collect();
        let batch = batch.with_context(|| input_name(&input.motions))?;
        if batch.is_empty() {
            break;
        }
        progress.begin_batch(batch.len(), rows.consumed_bytes());
        let judge = |row: MotionRow| {
            let truth = row.map(|(_, query)| {
                let truth = referee.first_contact(&query);
                TruthRow::new(query.id, query.duration, truth)
            });
            progress.step();
            truth
        };
        let truths: Vec<_> = batch.into_par_iter().map(judge).collect();
        for truth in truths {
            match truth {
                Ok(truth) => {
                    *counts.entry(truth.status).or_default() += 1;
                    widest = greater(widest, truth.bracket_width());
                    table.write_row(|writer| writer.serialize((truth, "")))?;
                }
                Err(error) => {
                    bad_rows.report(error.position, &error.problem, &progress);
                    let reason = error.problem.to_string();
                    table.write_row(|writer| {
                        writer.serialize((&error.id, "error", "", "", reason))
                    })?;
                }
            }
        }
        table.flush()?;
    }
    table.finish()?;
    drop(progress);
    bad_rows.print_total();
    if counts.is_empty() && bad_rows.count() == 0 {
        print_error(&format!(
            "{}: has a header, but no rows",
            input_name(&input.motions)
        ));
    }
    if !args.quiet {
        let seconds = start.elapsed().as_secs_f64();
        let _ = writeln!(io::stderr(), "{}, {seconds:.1} s", summary(&counts, widest));
    }
    Ok(match bad_rows.count() {
        0 => RunOutcome::AllAnswered,
        _ => RunOutcome::SomeRowsBad,
    })
}

/// Returns a line of text with the number of rows of each status, and the width of the widest bracket.
fn summary(counts: &HashMap<&str, usize>, widest: f64) -> String {
    let kinds = TRUTH_STATUSES.map(|kind| format!("{} {kind}", counts.get(kind).unwrap_or(&0)));
    let (rows, kinds): (usize, String) = (counts.values().sum(), kinds.join(", "));
    format!("{rows} rows: {kinds}; widest bracket {widest:.1e}")
}
