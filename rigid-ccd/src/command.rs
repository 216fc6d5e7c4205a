//! The command `ccd`: options, files in and out, progress, and what the exit code says.

mod bad_rows;
mod causes;
mod completions;
mod decompose;
mod files;
mod man;
mod pieces;
mod progress;
mod query;
mod size;

pub use bad_rows::BadRows;
pub use files::{CannotWrite, Table, input_name, open_motions, refuse_overwriting, same_file};
pub use progress::{Progress, Total};
pub use size::Size;

use clap::{Parser, Subcommand};
use completions::CompletionsArgs;
use decompose::DecomposeArgs;
use man::ManArgs;
use query::QueryArgs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// When do two moving bodies first touch, where, and with which features?
#[derive(Debug, Parser)]
#[command(name = "ccd", version, after_help = AFTER_HELP, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const AFTER_HELP: &str = "\
Examples:
  ccd query --a knot.obj --b knot.obj --motions motions.csv --out results.csv
  ccd decompose knot.obj --pieces patches --out knot.ccd
  ccd query --help";

#[derive(Debug, Subcommand)]
enum Command {
    /// Answer a table of motions of two bodies
    Query(Box<QueryArgs>),
    /// Prepare a mesh: count its pieces, write them, store the body
    Decompose(DecomposeArgs),
    /// Print a script that completes commands and options in a shell
    Completions(CompletionsArgs),
    /// Write man pages to a folder
    Man(ManArgs),
}

/// How a run ended that could write all it had to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Every row is answered.
    AllAnswered,
    /// Rows were bad; the others are answered.
    SomeRowsBad,
}

/// Runs the command that the process was started with.
pub fn main() -> ExitCode {
    exit_code(match Cli::parse().command {
        Command::Query(args) => query::run(&args),
        Command::Decompose(args) => decompose::run(&args),
        Command::Completions(args) => completions::run(&args),
        Command::Man(args) => man::run(&args),
    })
}

/// Reports an error, and returns the exit code: 0 for success, 1 for results that cannot be written, 2 for
/// bad input.
pub fn exit_code(outcome: anyhow::Result<Exit>) -> ExitCode {
    match outcome {
        Ok(Exit::AllAnswered) => ExitCode::SUCCESS,
        Ok(Exit::SomeRowsBad) => ExitCode::from(2),
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

/// Writes a message to standard error, behind the program's name.
pub fn complain(message: &str) {
    // A message that cannot be written is no reason to fail.
    let _ = writeln!(io::stderr(), "{}: {message}", program());
}

/// The name that the process was started by, without folder and extension.
fn program() -> String {
    let path = std::env::args_os().next().map(PathBuf::from);
    let name = path.as_deref().and_then(Path::file_stem);
    name.map_or("ccd".into(), |name| name.to_string_lossy().into_owned())
}
