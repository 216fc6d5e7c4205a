//! The journal of a run: its options, and a checkpoint after each batch of rows.
//!
//! The file is next to the tables. It stays when the run has finished, so that the same command with
//! `--resume` finds nothing left to do.

use crate::command::files::CannotWrite;
use crate::table::results::Status;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The progress of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Checkpoint {
    /// The number of rows of motions that are done, with those skipped before the first one selected.
    pub(super) rows: usize,
    /// The checksum of these rows.
    pub(super) checksum: u32,
    /// The number of these rows without a complete answer.
    pub(super) bad: usize,
    /// The number of rows of each status in the results.
    #[serde(default)]
    pub(super) counts: [usize; Status::ALL.len()],
    /// The length of the results, set when they are flushed.
    pub(super) results_bytes: u64,
    /// The length of the contacts, set when they are flushed.
    pub(super) contacts_bytes: u64,
    /// True when these are all rows.
    #[serde(default, rename = "whole")]
    pub(super) finished: bool,
}

/// Everything that the tables of a run depend on: options with their values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Recorded(pub(super) Vec<(String, String)>);

/// The prefix of an entry that holds the checksum of the file that an option names.
pub(super) const CONTENT: &str = "content-of:";

/// The file of the options and the checkpoints.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
}

/// The separator in the journal between the options and the checkpoints.
const CHECKPOINTS: &str = "\nmarks:\n";

impl Recorded {
    /// Returns one line for each option; line ends within values are escaped.
    fn to_text(&self) -> String {
        let mut text = String::new();
        for (option, value) in &self.0 {
            let _ = writeln!(text, "{option} {}", value.escape_debug());
        }
        text.trim_end().to_owned()
    }

    /// Describes the options that have changed; returns none when all are the same.
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
            match option.strip_prefix(CONTENT) {
                None => changes.push(format!("{option} was {then} and is now {now}")),
                // Another file has another content: one message is enough.
                Some(_) if !changes.is_empty() => {}
                Some(option) => changes.push(format!("the file of {option} has changed since")),
            }
        }
        Some(changes.join(", "))
    }
}

impl Journal {
    pub(super) fn create(path: PathBuf, recorded: &Recorded) -> Result<Self, CannotWrite> {
        let create = || {
            let mut file = File::create(&path)?;
            write!(file, "{}{CHECKPOINTS}", recorded.to_text())?;
            Ok(file)
        };
        match create() {
            Ok(file) => Ok(Journal { path, file }),
            Err(source) => Err(Journal::failed(&path, source)),
        }
    }

    /// Appends a checkpoint.
    pub(super) fn append(&mut self, checkpoint: Checkpoint) -> Result<(), CannotWrite> {
        let mut append = || {
            let line = serde_json::to_string(&checkpoint)? + "\n";
            self.file.write_all(line.as_bytes())
        };
        append().map_err(|source| Journal::failed(&self.path, source))
    }

    fn failed(path: &Path, source: io::Error) -> CannotWrite {
        CannotWrite {
            place: path.display().to_string(),
            source,
        }
    }
}

/// The journal of an earlier run.
pub(super) struct Earlier {
    recorded: String,
    /// The number of rows that it answered.
    pub(super) rows: usize,
    /// The last checkpoint.
    pub(super) checkpoint: Checkpoint,
    /// The length of the journal without an incomplete last line.
    bytes: u64,
}

/// A journal that is missing or damaged.
pub(super) struct Lost;

impl Earlier {
    /// Reads a journal; returns none for a run that ended before its first checkpoint.
    ///
    /// # Errors
    /// [`Lost`] when the journal is missing or damaged.
    pub(super) fn read(journal: &Path) -> Result<Option<Self>, Lost> {
        let text = fs::read_to_string(journal).map_err(|_| Lost)?;
        let (recorded, checkpoints) = text.split_once(CHECKPOINTS).ok_or(Lost)?;
        // A line without its end may be incomplete.
        let Some(end) = checkpoints.rfind('\n') else {
            return Ok(None);
        };
        let complete = &checkpoints[..end + 1];
        let mut lines = complete.lines().map(serde_json::from_str::<Checkpoint>);
        let first = lines.next().ok_or(Lost)?.map_err(|_| Lost)?;
        let checkpoint = lines.next_back().unwrap_or(Ok(first)).map_err(|_| Lost)?;
        Ok(Some(Earlier {
            recorded: recorded.to_owned(),
            rows: checkpoint.rows.saturating_sub(first.rows),
            checkpoint,
            bytes: (recorded.len() + CHECKPOINTS.len() + complete.len()) as u64,
        }))
    }

    /// Describes the options that differ from those of the earlier run.
    pub(super) fn changes(&self, recorded: &Recorded) -> Option<String> {
        recorded.changes(&self.recorded)
    }

    /// Opens the journal to append to it.
    pub(super) fn reopen(&self, path: PathBuf) -> Result<Journal, CannotWrite> {
        let open = || {
            let file = File::options().append(true).open(&path)?;
            file.set_len(self.bytes)?;
            Ok(file)
        };
        match open() {
            Ok(file) => Ok(Journal { path, file }),
            Err(source) => Err(Journal::failed(&path, source)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(values: [&str; 3]) -> Recorded {
        let options = ["ccd", "--a", "content-of:--a"];
        let pairs = options.iter().zip(values);
        Recorded(
            pairs
                .map(|(o, v)| ((*o).to_owned(), v.to_owned()))
                .collect(),
        )
    }

    #[test]
    fn changes_are_described() {
        let before = with(["1", "a \nb.obj", "12"]).to_text();
        for (values, expected) in [
            (["1", "a \nb.obj", "12"], None),
            (
                ["1", "c.obj", "13"],
                Some("--a was a \\nb.obj and is now c.obj"),
            ),
            (
                ["1", "a \nb.obj", "13"],
                Some("the file of --a has changed since"),
            ),
            (
                ["2", "a \nb.obj", "12"],
                Some("another version of ccd wrote it"),
            ),
        ] {
            let changes = with(values).changes(&before);
            assert_eq!(changes.as_deref(), expected, "{values:?}");
        }
        let older = "ccd 1\nQueryArgs {\n    a: \"x\",\n}";
        let changes = with(["1", "x", "12"]).changes(older).unwrap();
        assert_eq!(changes, "another version of ccd wrote it");
    }
}
