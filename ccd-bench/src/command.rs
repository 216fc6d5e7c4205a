//! The command line of `ccd-bench`, with a subcommand for each kind of comparison.

mod answer;
mod chart;
mod cost;
mod inputs;
mod judge;
mod stability;
mod truth;

use answer::AnswerArgs;
use chart::ChartArgs;
use clap::{Parser, Subcommand};
use cost::CostArgs;
use judge::JudgeArgs;
use rigid_ccd_cli::{OutputError, print_error_and_get_exit_code};
use stability::StabilityArgs;
use std::env;
use std::ffi::OsString;
use std::fmt::Display;
use std::io::{self, Write};
use std::process::ExitCode;
use truth::TruthArgs;

/// Compares methods of continuous collision detection: speed against accuracy
#[derive(Debug, Parser)]
#[command(name = "ccd-bench", version, after_help = AFTER_HELP)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const AFTER_HELP: &str = "\
Without any argument, `ccd-bench` does what `ccd-bench chart` does: that is the demo.

Examples:
  ccd-bench
  ccd-bench chart --scenes santa --tolerances 1e-3,1e-6
  ccd-bench truth --a knot.obj --b knot.obj --motions motions.csv --out truth.csv";

#[derive(Debug, Subcommand)]
enum Command {
    /// Compare all methods on the paper's five scenes: tables, a chart, a page (under a minute)
    Chart(ChartArgs),
    /// Bracket the exact times of first contact of two meshes, as the truth by which answers are judged
    Truth(TruthArgs),
    /// Find where each method fails: families of scenes that get harder step by step
    Stability(StabilityArgs),
    /// Ask one method about a table of motions, and judge its answers by the exact ones
    Judge(JudgeArgs),
    /// Measure what a query costs: visits, microseconds, nanoseconds a visit
    Cost(CostArgs),
    #[command(hide = true)]
    Answer(AnswerArgs),
}

/// Runs the subcommand given in the arguments of the process, or `chart` if there are no arguments.
pub fn main() -> ExitCode {
    let mut words: Vec<OsString> = env::args_os().collect();
    if words.len() < 2 {
        words.push("chart".into());
    }
    print_error_and_get_exit_code(match Cli::parse_from(words).command {
        Command::Chart(args) => chart::run(&args),
        Command::Truth(args) => truth::run(&args),
        Command::Stability(args) => stability::run(&args),
        Command::Judge(args) => judge::run(&args),
        Command::Cost(args) => cost::run(&args),
        Command::Answer(args) => answer::run(&args),
    })
}

/// Prints a summary of the results to standard output.
fn print_summary(text: &impl Display) -> Result<(), OutputError> {
    writeln!(io::stdout(), "{text}").map_err(|source| OutputError {
        file_or_stream: "the summary".to_owned(),
        source,
    })
}
