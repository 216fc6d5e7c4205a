//! The command line. Each subcommand has a file, and a folder if it needs more files.

mod acm;
mod check;
mod clearance;
mod completions;
mod decompose;
mod edges;
mod man;
mod query;
mod replay;
mod scene;
mod view;

use crate::console::causes::message_with_causes;
use crate::console::{RunOutcome, print_error};
use crate::files::output::OutputError;
use acm::AcmArgs;
use check::CheckArgs;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use clearance::ClearanceArgs;
use completions::CompletionsArgs;
use decompose::DecomposeArgs;
use edges::EdgesArgs;
use man::ManArgs;
use query::QueryArgs;
use replay::ReplayArgs;
use scene::SceneCommandArgs;
use std::io;
use std::process::ExitCode;
use view::ViewArgs;

/// Certified continuous collision detection: when do two moving rigid bodies first touch, where, and
/// with which features?
#[derive(Debug, Parser)]
#[command(name = "ccd", version, after_help = AFTER_HELP, arg_required_else_help = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    command: Command,
}

const AFTER_HELP: &str = "\
Examples:
  ccd query --a knot.obj --b knot.obj --motions motions.csv --out results.csv
  ccd query --a gripper.stl --b shelf.stl --motions edges.csv --check
  ccd view --a knot.obj --b knot.obj --motions motions.csv --out view.html
  ccd scene scene.csv --duration 0.5 --out contacts.csv
  ccd edges arm.urdf --cell cell.toml --edges moves.csv --out results.csv
  ccd clearance arm.urdf --joint elbow=-30deg:60deg --rest --require 5mm
  ccd acm arm.urdf --out arm.srdf
  ccd replay arm.urdf --cell cell.toml --record stop.json
  ccd query --a knot.obj --b knot.obj --motions motions.csv --certificates proofs
  ccd check proofs --a knot.obj --b knot.obj --motions motions.csv
  ccd decompose knot.obj --pieces patches --out knot.ccd
  ccd completions bash > ~/.local/share/bash-completion/completions/ccd

See `ccd help COMMAND` for the options, tables and exit codes of a command.";

#[derive(Debug, Subcommand)]
enum Command {
    /// Find the first contact of two bodies, or their least distance, for each row of a table of motions
    Query(Box<QueryArgs>),
    /// Write a page that shows queries, or a scene of many bodies: motions, contacts, the gap over time
    View(Box<ViewArgs>),
    /// List which bodies of a scene touch: when, where, with which features
    Scene(SceneCommandArgs),
    /// Certify edges or paths of a robot: free, first contact, or least distance
    Edges(Box<EdgesArgs>),
    /// Prove where a mechanism keeps a clearance, over the range of a joint or along a path
    Clearance(Box<ClearanceArgs>),
    /// Decide which pairs of a robot's links can touch, and write an SRDF that disables the pairs without need of a check
    Acm(Box<AcmArgs>),
    /// Ask recorded questions about a robot again, and say whether the recorded answers hold
    Replay(Box<ReplayArgs>),
    /// Check machine-checkable proofs of `ccd query` or `ccd edges`
    Check(Box<CheckArgs>),
    /// Split a mesh into convex pieces; print statistics, write the pieces or the prepared body
    Decompose(DecomposeArgs),
    /// Print a completion script for a shell
    Completions(CompletionsArgs),
    /// Write man pages for the command and each subcommand to a folder
    Man(ManArgs),
}

/// Parses the command line of this process, and runs the subcommand.
pub fn main() -> ExitCode {
    let matches = Cli::command().get_matches();
    let cli = Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    let command_matches = matches
        .subcommand()
        .map_or(&matches, |(_, options)| options);
    print_error_and_get_exit_code(match cli.command {
        Command::Query(args) => query::run(&args, command_matches),
        Command::View(args) => view::run(&args),
        Command::Scene(args) => scene::run(&args),
        Command::Edges(args) => edges::run(&args, command_matches),
        Command::Clearance(args) => clearance::run(&args),
        Command::Acm(args) => acm::run(&args),
        Command::Replay(args) => replay::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Decompose(args) => decompose::run(&args),
        Command::Completions(args) => completions::run(&args),
        Command::Man(args) => man::run(&args),
    })
}

/// Returns the exit code of a run, and prints its error, if there is one. The code is 0 for success, 1 for results that
/// cannot be written, 2 for bad input, and 3 if something is not proven.
pub fn print_error_and_get_exit_code(outcome: anyhow::Result<RunOutcome>) -> ExitCode {
    match outcome {
        Ok(RunOutcome::AllAnswered) => ExitCode::SUCCESS,
        Ok(RunOutcome::SomeRowsBad) => ExitCode::from(2),
        Ok(RunOutcome::SomeRowsUnproven) => ExitCode::from(3),
        Err(error) => match error.downcast_ref::<OutputError>() {
            // The reader closed the pipe, which is not a failure.
            Some(output_error) if output_error.source.kind() == io::ErrorKind::BrokenPipe => {
                ExitCode::SUCCESS
            }
            output_error => {
                print_error(&message_with_causes(&error));
                // Another run holds the output, so this run must not start.
                let is_busy = |f: &OutputError| f.source.kind() == io::ErrorKind::ResourceBusy;
                ExitCode::from(if output_error.is_none_or(is_busy) {
                    2
                } else {
                    1
                })
            }
        },
    }
}
