//! `ccd man`: man pages for the command and each subcommand.

use super::{Cli, Exit};
use crate::command::files::{CannotWrite, check_folder};
use anyhow::Result;
use clap::{Args, CommandFactory};
use std::path::PathBuf;

/// Write man pages for the command and each subcommand to a folder
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct ManArgs {
    /// Existing folder to write to
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

const AFTER_HELP: &str = "\
Examples:
  ccd man ~/.local/share/man/man1
  ccd man . && man ./ccd-query.1";

pub(super) fn run(args: &ManArgs) -> Result<Exit> {
    let folder = &args.folder;
    check_folder(&folder.join("ccd.1"))
        .and_then(|()| clap_mangen::generate_to(Cli::command(), folder))
        .map_err(|source| CannotWrite {
            place: "man pages".to_owned(),
            source,
        })?;
    Ok(Exit::AllAnswered)
}
