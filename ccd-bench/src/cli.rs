//! The command line: what can be said, and what the exit code says.

mod decompose;
mod pieces;
mod query;

use crate::demo::{DemoError, DemoOptions, demo};
use anyhow::{Result, ensure};
use clap::{Args, Parser, Subcommand};
use decompose::DecomposeArgs;
use query::QueryArgs;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

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
  ccd query --help";

#[derive(Debug, Subcommand)]
enum Command {
    /// Compare all methods on the paper's five scenes, as a table (under a minute)
    Demo(DemoArgs),
    /// Answer a table of motions of two bodies
    Query(Box<QueryArgs>),
    /// Prepare a mesh: count the pieces it becomes, write them, store the body
    Decompose(DecomposeArgs),
}

#[derive(Debug, Default, Args)]
struct DemoArgs {
    /// Use the meshes found here (bunny70k.obj, bunny26k.obj, santa.obj, knot2880.obj, …) in place
    /// of the models made by code
    #[arg(long, value_name = "DIR")]
    models: Option<PathBuf>,
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
        .unwrap_or_else(|| Command::Demo(DemoArgs::default()))
    {
        Command::Demo(args) => run_demo(args),
        Command::Query(args) => query::run(&args),
        Command::Decompose(args) => decompose::run(&args),
    };
    match outcome {
        Ok(Verdict::AllAnswered) => ExitCode::SUCCESS,
        Ok(Verdict::SomeRowsBad) => ExitCode::from(2),
        Err(error) => match error.downcast_ref::<CannotWrite>() {
            // The reader of a pipe has seen enough.
            Some(failed) if failed.source.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
            failed => {
                complain(&format!("{error:#}"));
                ExitCode::from(if failed.is_some() { 1 } else { 2 })
            }
        },
    }
}

fn run_demo(args: DemoArgs) -> Result<Verdict> {
    if let Some(directory) = &args.models {
        ensure!(
            directory.is_dir(),
            "{} is no directory; give --models one that holds meshes such as bunny70k.obj",
            directory.display()
        );
    }
    let options = DemoOptions {
        models: args.models,
    };
    demo(&options, &mut io::stdout().lock()).map_err(|error| match error {
        DemoError::Output(source) => CannotWrite {
            place: "the table".to_owned(),
            source,
        }
        .into(),
        other => anyhow::Error::from(other),
    })?;
    Ok(Verdict::AllAnswered)
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
