//! `ccd man`: man pages, one for the command and one for each of its parts.

use super::{Cli, Exit};
use crate::command::files::CannotWrite;
use anyhow::Result;
use clap::{Args, CommandFactory};
use std::path::PathBuf;

/// Write man pages to a folder
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct ManArgs {
    /// The folder, which must exist
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

const AFTER_HELP: &str = "\
Examples:
  ccd man ~/.local/share/man/man1
  ccd man . && man ./ccd-query.1";

pub(super) fn run(args: &ManArgs) -> Result<Exit> {
    clap_mangen::generate_to(Cli::command(), &args.folder).map_err(|source| CannotWrite {
        place: args.folder.display().to_string(),
        source,
    })?;
    Ok(Exit::AllAnswered)
}
