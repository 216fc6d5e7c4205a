//! `ccd completions`: completion scripts for shells.

use super::Cli;
use crate::console::{RunOutcome, standard_output};
use crate::files::output::OutputError;
use anyhow::Result;
use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};
use std::io::Write;

/// Print a completion script for a shell
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct CompletionsArgs {
    /// Shell to print the script for
    #[arg(value_enum)]
    shell: Shell,
}

const AFTER_HELP: &str = "\
Examples:
  ccd completions bash > ~/.local/share/bash-completion/completions/ccd
  ccd completions zsh > ~/.zfunc/_ccd
  ccd completions fish > ~/.config/fish/completions/ccd.fish";

pub(crate) fn run(args: &CompletionsArgs) -> Result<RunOutcome> {
    let mut script = Vec::new();
    generate(args.shell, &mut Cli::command(), "ccd", &mut script);
    let written = standard_output::lock().and_then(|mut stream| stream.write_all(&script));
    written.map_err(OutputError::standard_output_error)?;
    Ok(RunOutcome::AllAnswered)
}
