//! `ccd truth`: two meshes and a table of motions in, a table of brackets of the exact first contacts out.

use super::files::{Output, input_name, read_motions, refuse_overwriting};
use super::{Verdict, complain, same_file};
use crate::motions::Query;
use crate::progress::{Progress, Spinner};
use crate::referee::{Referee, Surface, Truth, TruthRow, write_truths};
use anyhow::{Context, Result};
use ccd_core::order::greater;
use ccd_decomp::TriangleMesh;
use clap::Args;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
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
    /// The table of motions, CSV, as of `ccd query`; - reads standard input
    #[arg(long, value_name = "CSV")]
    motions: PathBuf,
    /// Threads to work on; any number gives the same brackets [default: all there are]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// The table of truths, CSV; - writes to standard output
    #[arg(long, value_name = "CSV", default_value = "-")]
    out: PathBuf,
    /// Say nothing on standard error but what is wrong
    #[arg(long, short)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
Examples:
  ccd truth --a knot.obj --b knot.obj --motions motions.csv --out truth.csv
  printf 'a_pz,a_vz\\n3,-4\\n' | ccd truth --a part.stl --b slab.obj --motions -

See `ccd truth --help` for the columns of the table and the exit code.";

const AFTER_LONG_HELP: &str = "\
The bodies are surfaces: what is inside one is apart from it. The method is none of those that
`ccd query` has, and is made to be right, not fast: bisection in time, each step certified against
rounding.

Table of truths:
  id        as in the table of motions (see `ccd query --help` for its columns)
  status    hit        the first contact is not before lo and not after hi, usually 1e-13 apart
            free       apart for the whole duration; lo and hi are the duration
            initial    they touch at the start, or all but touch; lo and hi are 0
            graze      apart before lo, at lo in touch or all but, never shown to intersect
            undecided  apart before lo, nothing known after: the work for a row was spent

Exit code: 0 when every row is judged, 2 on bad input: rows that are good are judged and written all
the same; 1 when the table cannot be written.

Examples:
  ccd truth --a knot.obj --b knot.obj --motions motions.csv --out truth.csv
  ccd truth --a part.stl --b part.stl --motions motions.csv --threads 1 --out truth.csv
  printf 'a_pz,a_vz\\n3,-4\\n' | ccd truth --a part.stl --b slab.obj --motions -";

/// Judges all rows that can be; the others are told on standard error.
pub(super) fn run(args: &TruthArgs) -> Result<Verdict> {
    refuse_overwriting(("--motions", &args.motions), ("--out", &args.out))?;
    let (a, b) = load(args)?;
    let table = read_motions(&args.motions)?;
    // Before the work, not after it, is when to learn that its result has nowhere to go.
    let out = Output::open(&args.out)?;
    let queries: Vec<&Query> = table.rows.iter().map(|(_, query)| query).collect();
    let start = Instant::now();
    let truths = judge(args, Referee::new(&a, b.as_ref().unwrap_or(&a)), &queries)?;
    let seconds = start.elapsed().as_secs_f64();
    let rows = queries.into_iter().zip(&truths);
    let rows = rows.map(|(query, &truth)| TruthRow::new(query.id.clone(), query.duration, truth));
    out.write(|writer| write_truths(writer, rows))?;
    for error in &table.errors {
        complain(&format!("{}, {error}", input_name(&args.motions)));
    }
    if !args.quiet {
        let _ = writeln!(io::stderr(), "{}, {seconds:.1} s", summary(&truths));
    }
    Ok(match table.errors.is_empty() {
        true => Verdict::AllAnswered,
        false => Verdict::SomeRowsBad,
    })
}

/// The surfaces; B is none of its own when it comes from where A comes from.
fn load(args: &TruthArgs) -> Result<(Surface, Option<Surface>)> {
    let surface = |option: &str, path: &Path| -> Result<Surface> {
        let spinner = match args.quiet {
            true => Spinner::hidden(),
            false => Spinner::new(&format!("reading {}", path.display())),
        };
        let mesh = TriangleMesh::read(path).with_context(|| option.to_owned())?;
        let surface = Surface::new(&mesh);
        drop(spinner);
        Ok(surface)
    };
    let a = surface("--a", &args.a)?;
    let b = match same_file(&args.a, &args.b) {
        true => None,
        false => Some(surface("--b", &args.b)?),
    };
    Ok((a, b))
}

fn judge(args: &TruthArgs, referee: Referee<'_>, queries: &[&Query]) -> Result<Vec<Truth>> {
    let progress = match args.quiet {
        true => Progress::hidden(),
        false => Progress::new(queries.len()),
    };
    let judge = |query: &&Query| {
        let truth = referee.first_contact(query);
        progress.step();
        truth
    };
    // 0 is rayon's word for all there are.
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(args.threads.map_or(0, usize::from))
        .build()?;
    Ok(pool.install(|| queries.par_iter().map(judge).collect()))
}

/// How many there are of each kind, and the widest bracket.
fn summary(truths: &[Truth]) -> String {
    let count = |kind: fn(&Truth) -> bool| truths.iter().filter(|truth| kind(truth)).count();
    let width = |truth: &Truth| match truth {
        Truth::Hit { lo, hi } => hi - lo,
        _ => 0.0,
    };
    format!(
        "{} rows: {} hit, {} free, {} initial, {} graze, {} undecided; widest bracket {:.1e}",
        truths.len(),
        count(|truth| matches!(truth, Truth::Hit { .. })),
        count(|truth| matches!(truth, Truth::Free)),
        count(|truth| matches!(truth, Truth::Start)),
        count(|truth| matches!(truth, Truth::Graze { .. })),
        count(|truth| matches!(truth, Truth::Undecided { .. })),
        truths.iter().map(width).fold(0.0, greater),
    )
}
