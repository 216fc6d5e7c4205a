//! The command line: what can be said, and what the exit code says.

mod causes;
mod chart;
mod decompose;
mod files;
mod peer;
mod pieces;
mod query;
mod size;
mod told;
mod truth;

use chart::{ChartArgs, CommonArgs};
use clap::{Parser, Subcommand};
use decompose::DecomposeArgs;
use peer::PeerArgs;
use query::QueryArgs;
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;
use truth::TruthArgs;

/// When do two moving bodies first touch, where, and with which features?
#[derive(Debug, Parser)]
#[command(name = "ccd", version, after_help = AFTER_HELP)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

const AFTER_HELP: &str = "\
Without a command, `ccd` runs the demo.

Examples:
  ccd
  ccd query --a knot.obj --b knot.obj --motions motions.csv --out results.csv
  ccd decompose knot.obj --pieces patches --out knot.ccd
  ccd chart --scenes santa --tolerances 1e-3,1e-6
  ccd query --help";

#[derive(Debug, Subcommand)]
enum Command {
    /// Compare all methods on the paper's five scenes: a table, charts, a page (under a minute)
    Demo(CommonArgs),
    /// Measure speed against accuracy: scenes, methods and tolerances of your choice
    Chart(ChartArgs),
    /// Answer a table of motions of two bodies
    Query(Box<QueryArgs>),
    /// Prepare a mesh: count the pieces it becomes, write them, store the body
    Decompose(DecomposeArgs),
    /// Bracket the exact first contacts of two meshes, to judge answers by
    Truth(TruthArgs),
    #[command(hide = true)]
    Peer(PeerArgs),
}

/// What a run came to.
enum Verdict {
    AllAnswered,
    SomeRowsBad,
}

/// Results that have nowhere to go: not the input's fault.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {place}: {source}")]
struct CannotWrite {
    place: String,
    source: io::Error,
}

/// Runs the command that the process was started with.
pub fn main() -> ExitCode {
    let outcome = match Cli::parse()
        .command
        .unwrap_or_else(|| Command::Demo(CommonArgs::default()))
    {
        Command::Demo(args) => chart::run_demo(&args),
        Command::Chart(args) => chart::run(&args),
        Command::Query(args) => query::run(&args),
        Command::Decompose(args) => decompose::run(&args),
        Command::Truth(args) => truth::run(&args),
        Command::Peer(args) => peer::run(&args),
    };
    match outcome {
        Ok(Verdict::AllAnswered) => ExitCode::SUCCESS,
        Ok(Verdict::SomeRowsBad) => ExitCode::from(2),
        Err(error) => match error.downcast_ref::<CannotWrite>() {
            // The reader of a pipe has seen enough.
            Some(failed) if failed.source.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
            failed => {
                complain(&causes::in_words(&error));
                ExitCode::from(if failed.is_some() { 1 } else { 2 })
            }
        },
    }
}

/// Tells the user; that nobody can be told is no reason to fail.
fn complain(message: &str) {
    let _ = writeln!(io::stderr(), "ccd: {message}");
}

/// Whether two paths lead to one file.
fn same_file(a: &Path, b: &Path) -> bool {
    let place = |path: &Path| fs::canonicalize(path).ok();
    a == b || place(a).is_some_and(|a| Some(a) == place(b))
}
