//! The journal of a run of `ccd query`: its options, and a checkpoint after each batch of rows.
//!
//! The file is next to the tables. Each checkpoint ends with the checksum of all before it. It stays when the run has finished, so that the same command with
//! `--resume` finds nothing left to do.

use crate::command::counts::Counts;
use crate::command::output::CannotWrite;
use crate::command::table::WrittenSize;
use crc32fast::Hasher;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The state of a run after a batch of rows, from which it can be continued.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Checkpoint {
    /// The number of finished rows of the table of motions, including rows skipped before the selected ones.
    pub(super) rows: usize,
    /// The checksum of the finished rows' input.
    pub(super) checksum: u32,
    /// The number of finished rows without a complete answer.
    pub(super) bad: usize,
    /// The number of finished rows with each status.
    pub(super) counts: Counts,
    /// The length and checksum of the table of results, set when it is flushed.
    pub(super) results: WrittenSize,
    /// The length and checksum of the table of contacts, set when it is flushed.
    pub(super) contacts: WrittenSize,
    /// Whether the run has answered all selected rows.
    #[serde(rename = "whole")]
    pub(super) finished: bool,
}

/// The options that determine the tables of a run, each with its value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct RecordedOptions(pub(super) Vec<(String, String)>);

/// The prefix of an entry that holds the checksum of the file that an option names.
pub(super) const CONTENT_PREFIX: &str = "content-of:";

/// The journal file: the options of the run, followed by checkpoints.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    /// The checksum of what has been written to the journal.
    sum: Hasher,
}

/// The line between the options and the checkpoints in the journal.
const CHECKPOINTS: &str = "\nmarks:\n";

impl RecordedOptions {
    /// Returns the options as text with one line each; line ends within values are escaped.
    fn to_text(&self) -> String {
        let mut text = String::new();
        for (option, value) in &self.0 {
            let _ = writeln!(text, "{option} {}", value.escape_debug());
        }
        text.trim_end().to_owned()
    }

    /// Describes the options that differ from those in `before`; `None` if all are the same.
    fn changes(&self, before: &str) -> Option<String> {
        let now = self.to_text();
        if before == now {
            return None;
        }
        let split = |line| str::split_once(line, ' ').unwrap_or((line, ""));
        let then: Vec<_> = before.lines().map(split).collect();
        let now: Vec<_> = now.lines().map(split).collect();
        let (version, known) = (then.first(), now.iter().map(|(option, _)| option));
        if version != now.first() || !known.eq(then.iter().map(|(option, _)| option)) {
            return Some("another version of ccd wrote it".to_owned());
        }
        let mut changes = Vec::new();
        for ((option, then), (_, now)) in then.iter().zip(&now).filter(|(then, now)| then != now) {
            match option.strip_prefix(CONTENT_PREFIX) {
                None => changes.push(format!("{option} was {then} and is now {now}")),
                // A changed file name implies changed content, so one message is enough.
                Some(_) if !changes.is_empty() => {}
                Some(option) => changes.push(format!("the file of {option} has changed since")),
            }
        }
        Some(changes.join(", "))
    }
}

impl Journal {
    pub(super) fn create(path: PathBuf, recorded: &RecordedOptions) -> Result<Self, CannotWrite> {
        let head = format!("{}{CHECKPOINTS}", recorded.to_text());
        let mut sum = Hasher::new();
        sum.update(head.as_bytes());
        let create = || {
            let mut file = File::create(&path)?;
            file.write_all(head.as_bytes())?;
            Ok(file)
        };
        match create() {
            Ok(file) => Ok(Journal { path, file, sum }),
            Err(source) => Err(CannotWrite::at(&path, source)),
        }
    }

    /// Appends a checkpoint to the journal.
    pub(super) fn append(&mut self, checkpoint: Checkpoint) -> Result<(), CannotWrite> {
        let mut append = || {
            let line = with_checksum(serde_json::to_string(&checkpoint)?, &mut self.sum);
            self.file.write_all(line.as_bytes())
        };
        append().map_err(|source| CannotWrite::at(&self.path, source))
    }
}

/// Returns a checkpoint's line with its checksum at the end, and adds the line to `sum`.
fn with_checksum(mut line: String, sum: &mut Hasher) -> String {
    sum.update(line.as_bytes());
    let _ = writeln!(line, " {:08x}", sum.clone().finalize());
    line
}

/// What the journal of an earlier run tells.
pub(super) struct EarlierRun {
    recorded_options: String,
    /// The number of rows that the earlier run answered.
    pub(super) rows: usize,
    /// The last checkpoint in the journal.
    pub(super) checkpoint: Checkpoint,
    /// The length of the journal without an incomplete last line.
    bytes: u64,
    /// The checksum of the journal without an incomplete last line.
    sum: Hasher,
}

/// The error of a journal that is missing or damaged.
pub(super) struct JournalLost;

impl EarlierRun {
    /// Reads the journal of an earlier run; `None` for a run that ended before its first checkpoint.
    ///
    /// # Errors
    /// [`JournalLost`] when the journal is missing or damaged.
    pub(super) fn read(journal: &Path) -> Result<Option<Self>, JournalLost> {
        let text = fs::read_to_string(journal).map_err(|_| JournalLost)?;
        let (recorded, checkpoints) = text.split_once(CHECKPOINTS).ok_or(JournalLost)?;
        // A line without a line end may be incomplete.
        let Some(end) = checkpoints.rfind('\n') else {
            return Ok(None);
        };
        let complete = &checkpoints[..end + 1];
        let mut sum = Hasher::new();
        sum.update(recorded.as_bytes());
        sum.update(CHECKPOINTS.as_bytes());
        let mut lines = complete
            .split_inclusive('\n')
            .map(|line| parse_checked(line, &mut sum));
        let first = lines.next().ok_or(JournalLost)??;
        let checkpoint = lines.try_fold(first, |_, next| next)?;
        Ok(Some(EarlierRun {
            recorded_options: recorded.to_owned(),
            rows: checkpoint.rows.saturating_sub(first.rows),
            checkpoint,
            bytes: (recorded.len() + CHECKPOINTS.len() + complete.len()) as u64,
            sum,
        }))
    }

    /// Describes the options that differ from those of the earlier run.
    pub(super) fn changes(&self, recorded: &RecordedOptions) -> Option<String> {
        recorded.changes(&self.recorded_options)
    }

    /// Opens the journal to append to it.
    pub(super) fn reopen(&self, path: PathBuf) -> Result<Journal, CannotWrite> {
        let open = || {
            let file = File::options().append(true).open(&path)?;
            file.set_len(self.bytes)?;
            Ok(file)
        };
        match open() {
            Ok(file) => {
                let sum = self.sum.clone();
                Ok(Journal { path, file, sum })
            }
            Err(source) => Err(CannotWrite::at(&path, source)),
        }
    }
}

/// Parses a checkpoint and verifies its [checksum](with_checksum).
fn parse_checked(line: &str, sum: &mut Hasher) -> Result<Checkpoint, JournalLost> {
    let (checkpoint, _) = line.rsplit_once(' ').ok_or(JournalLost)?;
    if with_checksum(checkpoint.to_owned(), sum) == line {
        serde_json::from_str(checkpoint).map_err(|_| JournalLost)
    } else {
        Err(JournalLost)
    }
}

#[cfg(test)]
mod tests;
