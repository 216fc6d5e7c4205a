//! The journal of a run: its options, and a checkpoint after each batch of rows.
//!
//! The file is next to the tables. Each checkpoint ends with the checksum of the journal up to there. The file stays
//! when the run has finished, so that the same command with `--resume` finds nothing left to do.

use crate::files::output::OutputError;
use crate::files::table::LengthAndChecksum;
use crate::rows::counts::StatusCounts;
use clap::{ArgMatches, Args, Command};
use crc32fast::Hasher;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The state of a run after a batch of rows, from which it can be continued.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Checkpoint {
    /// The number of finished rows of the input, including rows skipped before the selected ones.
    pub(crate) rows: usize,
    /// The checksum of the input up to the end of the finished rows.
    pub(crate) checksum: u32,
    /// The number of finished rows without a complete answer.
    pub(crate) bad_rows: usize,
    /// The number of finished rows with each status.
    pub(crate) counts: StatusCounts,
    /// The length and checksum of the table of results, set when it is flushed.
    pub(crate) results: LengthAndChecksum,
    /// The length and checksum of the table of contacts, set when it is flushed.
    pub(crate) contacts: LengthAndChecksum,
    /// Whether the run has answered all selected rows.
    #[serde(rename = "whole")]
    pub(crate) finished: bool,
}

/// The prefix of an option's name in a journal entry that holds the checksum of the file that the option names.
pub(crate) const FILE_CHECKSUM_PREFIX: &str = "content-of:";

/// The journal file: the options of the run, then a line for each checkpoint. A run continues from the last checkpoint.
pub(crate) struct Journal {
    path: PathBuf,
    file: File,
    /// The checksum of what has been written to the journal.
    checksum_hasher: Hasher,
}

/// The line between the options and the checkpoints in the journal.
const CHECKPOINTS_HEADING: &str = "\nmarks:\n";

/// Returns options with their values as text with one line each; line ends within values are escaped.
pub(crate) fn options_text(options: impl IntoIterator<Item = (String, String)>) -> String {
    let lines = options
        .into_iter()
        .map(|(option, value)| format!("{option} {}", value.escape_debug()));
    lines.collect::<Vec<_>>().join("\n")
}

/// Returns the options of a command that determine its tables, with their given or default values. Options without a
/// long name, such as positional files, are named by their ids.
pub(crate) fn option_values<A: Args>(
    matches: &ArgMatches,
    unrecorded_ids: &[&str],
) -> Vec<(String, String)> {
    let command = A::augment_args(Command::new("ccd"));
    let options = command
        .get_arguments()
        .filter(|option| !unrecorded_ids.contains(&option.get_id().as_str()));
    let recorded = options.map(|option| {
        let id = option.get_id().as_str();
        let values = matches.get_raw(id).into_iter().flatten();
        let values: Vec<_> = values.map(|value| value.to_string_lossy()).collect();
        let value = match values.join(",") {
            none if none.is_empty() => "not given".to_owned(),
            values => values,
        };
        let name = option.get_long().unwrap_or(id);
        (format!("--{name}"), value)
    });
    recorded.collect()
}

impl Journal {
    /// Replaces any older journal by a new one with the run's options and, if the run is resumed, its checkpoint.
    pub(crate) fn start(
        path: PathBuf,
        options: &str,
        from: Option<&Checkpoint>,
    ) -> Result<Self, OutputError> {
        let mut text = format!("{options}{CHECKPOINTS_HEADING}");
        let mut checksum = Hasher::new();
        checksum.update(text.as_bytes());
        let mut open = || {
            if let Some(from) = from {
                text += &line(from, &mut checksum)?;
            }
            ccd_file::write(&path, |out| out.write_all(text.as_bytes()))?;
            File::options().append(true).open(&path)
        };
        let file = open().map_err(|source| OutputError::error_for_path(&path, source))?;
        Ok(Journal {
            path,
            file,
            checksum_hasher: checksum,
        })
    }

    /// Appends a checkpoint to the journal.
    pub(crate) fn append(&mut self, checkpoint: Checkpoint) -> Result<(), OutputError> {
        line(&checkpoint, &mut self.checksum_hasher)
            .and_then(|line| self.file.write_all(line.as_bytes()))
            .map_err(|source| OutputError::error_for_path(&self.path, source))
    }
}

/// Formats a checkpoint as a line that ends with a checksum of the whole journal so far, and adds the line to `sum`.
fn line(checkpoint: &Checkpoint, checksum: &mut Hasher) -> io::Result<String> {
    let checkpoint = serde_json::to_string(checkpoint)?;
    checksum.update(checkpoint.as_bytes());
    let end = format!(" {:08x}\n", checksum.clone().finalize());
    checksum.update(end.as_bytes());
    Ok(checkpoint + &end)
}

/// The options and the last checkpoint that the journal of an earlier run records.
pub(crate) struct EarlierRun {
    options: String,
    /// The last checkpoint in the journal.
    pub(crate) checkpoint: Checkpoint,
}

/// The error of a journal that is missing or damaged.
pub(crate) struct JournalError;

impl EarlierRun {
    /// Reads the journal of an earlier run; `None` for a run that ended before its first checkpoint.
    ///
    /// # Errors
    /// [`JournalError`] when the journal is missing or damaged.
    pub(crate) fn read(journal: &Path) -> Result<Option<Self>, JournalError> {
        let text = ccd_file::read_to_string(journal).map_err(|_| JournalError)?;
        let (options, checkpoints) = text.split_once(CHECKPOINTS_HEADING).ok_or(JournalError)?;
        // A line without a line end may be incomplete.
        let Some((checkpoints, incomplete)) = checkpoints.rsplit_once('\n') else {
            return Ok(None);
        };
        let complete = &text[..text.len() - incomplete.len() - 1];
        let (checked_text, checksum) = complete.rsplit_once(' ').ok_or(JournalError)?;
        if format!("{:08x}", crc32fast::hash(checked_text.as_bytes())) != checksum {
            return Err(JournalError);
        }
        let last = checkpoints.lines().next_back().unwrap_or_default();
        let checkpoint = last.strip_suffix(checksum).unwrap_or_default();
        Ok(Some(EarlierRun {
            options: options.to_owned(),
            checkpoint: serde_json::from_str(checkpoint).map_err(|_| JournalError)?,
        }))
    }

    /// Describes the options that differ from the options of the earlier run; `None` if all are the same.
    pub(crate) fn describe_changes(&self, current_options: &str) -> Option<String> {
        if self.options == current_options {
            return None;
        }
        let split = |line| str::split_once(line, ' ').unwrap_or((line, ""));
        let [earlier_options, current_options] = [&self.options, current_options]
            .map(|text| text.lines().map(split).collect::<Vec<_>>());
        let (version, option_names) = (
            earlier_options.first(),
            current_options.iter().map(|(option, _)| option),
        );
        if version != current_options.first()
            || !option_names.eq(earlier_options.iter().map(|(option, _)| option))
        {
            return Some("another version of ccd wrote it".to_owned());
        }
        let mut changes = Vec::new();
        let pairs = earlier_options.iter().zip(&current_options);
        for ((option, earlier), (_, current)) in
            pairs.filter(|(earlier, current)| earlier != current)
        {
            match option.strip_prefix(FILE_CHECKSUM_PREFIX) {
                None => changes.push(format!("{option} was {earlier} and is now {current}")),
                // A changed file name implies changed content, so one message is enough.
                Some(_) if !changes.is_empty() => {}
                Some(option) => changes.push(format!("the file of {option} has changed since")),
            }
        }
        Some(changes.join(", "))
    }
}

#[cfg(test)]
mod tests;
