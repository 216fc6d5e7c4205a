//! `ccd man`: man pages for the command and each subcommand.

use super::Cli;
use crate::console::RunOutcome;
use crate::files::output::OutputError;
use anyhow::Result;
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use std::path::{Path, PathBuf};

/// Write man pages for the command and each subcommand to a folder
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct ManArgs {
    /// Existing folder to write to
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

const AFTER_HELP: &str = "\
Examples:
  ccd man ~/.local/share/man/man1
  ccd man . && man ./ccd-query.1";

pub(crate) fn run(args: &ManArgs) -> Result<RunOutcome> {
    let mut command = Cli::command().disable_help_subcommand(true);
    command.build();
    write(command, &args.folder)?;
    Ok(RunOutcome::AllAnswered)
}

/// Writes the man pages of a command and of all its subcommands into a folder.
fn write(command: Command, folder: &Path) -> Result<(), OutputError> {
    for below in command.get_subcommands().filter(|c| !c.is_hide_set()) {
        write(below.clone(), folder)?;
    }
    let page = Man::new(command);
    let path = folder.join(page.get_filename());
    ccd_file::write(&path, |out| page.render(out))
        .map_err(|error| OutputError::error_for_path(&path, error))
}
