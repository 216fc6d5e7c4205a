//! What a run notes of itself beside its tables: what it was asked, and how far it has come.
//!
//! The options stand first, then a line for each batch of rows. The file stays when the run is finished, so
//! that the same command with `--resume` finds nothing left to do.

use crate::command::files::CannotWrite;
use crate::table::results::Status;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// How far a run has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Mark {
    /// Rows of motions that are done with, all before the first one asked for included.
    pub(super) rows: usize,
    /// The checksum of these.
    pub(super) checksum: u32,
    /// How many of them have no complete answer.
    pub(super) bad: usize,
    /// How many rows of each status the results have.
    #[serde(default)]
    pub(super) counts: [usize; Status::ALL.len()],
    /// How long the tables are: known once they are handed on.
    pub(super) results_bytes: u64,
    pub(super) contacts_bytes: u64,
    /// Whether these are all rows there are.
    #[serde(default)]
    pub(super) whole: bool,
}

/// All that the tables of a run depend on: options, and what they are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Settings(pub(super) Vec<(String, String)>);

/// What is said of the checksum of a file that an option names, and of no option.
pub(super) const CONTENT: &str = "content-of:";

/// The file of the options and the marks.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
}

/// Stands in the journal between the options and the marks.
const MARKS: &str = "\nmarks:\n";

impl Settings {
    /// One a line; what values are never ends one.
    fn to_text(&self) -> String {
        let mut text = String::new();
        for (option, value) in &self.0 {
            let _ = writeln!(text, "{option} {}", value.escape_debug());
        }
        text.trim_end().to_owned()
    }

    /// What is not as it was, in words; none where all is.
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
                None => changes.push(format!("{option} was {then} and is {now} now")),
                // Another file has another content.
                Some(_) if !changes.is_empty() => {}
                Some(option) => changes.push(format!("the file of {option} has changed since")),
            }
        }
        Some(changes.join(", "))
    }
}

impl Journal {
    pub(super) fn create(path: PathBuf, settings: &Settings) -> Result<Self, CannotWrite> {
        let create = || {
            let mut file = File::create(&path)?;
            write!(file, "{}{MARKS}", settings.to_text())?;
            Ok(file)
        };
        match create() {
            Ok(file) => Ok(Journal { path, file }),
            Err(source) => Err(Journal::failed(&path, source)),
        }
    }

    /// Adds a mark.
    pub(super) fn note(&mut self, mark: Mark) -> Result<(), CannotWrite> {
        let mut note = || {
            let line = serde_json::to_string(&mark)? + "\n";
            self.file.write_all(line.as_bytes())
        };
        note().map_err(|source| Journal::failed(&self.path, source))
    }

    fn failed(path: &Path, source: io::Error) -> CannotWrite {
        CannotWrite {
            place: path.display().to_string(),
            source,
        }
    }
}

/// What an earlier run has left.
pub(super) struct Left {
    settings: String,
    /// How many rows it answered.
    pub(super) rows: usize,
    pub(super) mark: Mark,
    /// How much of the journal is whole.
    bytes: u64,
}

impl Left {
    /// None when it did not come to its first mark.
    pub(super) fn read(journal: &Path) -> Option<Self> {
        let text = fs::read_to_string(journal).ok()?;
        let (settings, marks) = text.split_once(MARKS)?;
        // A line without its end may be cut.
        let whole = &marks[..marks.rfind('\n')? + 1];
        let mut lines = whole.lines().map(serde_json::from_str::<Mark>);
        let first = lines.next()?.ok()?;
        let mark = lines.next_back().unwrap_or(Ok(first)).ok()?;
        Some(Left {
            settings: settings.to_owned(),
            rows: mark.rows.saturating_sub(first.rows),
            mark,
            bytes: (settings.len() + MARKS.len() + whole.len()) as u64,
        })
    }

    /// What it was asked otherwise, in words: rows of one table are answers to one question.
    pub(super) fn changes(&self, settings: &Settings) -> Option<String> {
        settings.changes(&self.settings)
    }

    /// Its journal, to go on with.
    pub(super) fn continued(&self, path: PathBuf) -> Result<Journal, CannotWrite> {
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

    fn settings(values: [&str; 3]) -> Settings {
        let options = ["ccd", "--a", "content-of:--a"];
        let pairs = options.iter().zip(values);
        Settings(
            pairs
                .map(|(o, v)| ((*o).to_owned(), v.to_owned()))
                .collect(),
        )
    }

    #[test]
    fn what_has_changed_is_told_in_words() {
        let before = settings(["1", "a \nb.obj", "12"]).to_text();
        for (values, told) in [
            (["1", "a \nb.obj", "12"], None),
            (
                ["1", "c.obj", "13"],
                Some("--a was a \\nb.obj and is c.obj now"),
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
            let changes = settings(values).changes(&before);
            assert_eq!(changes.as_deref(), told, "{values:?}");
        }
        let older = "ccd 1\nQueryArgs {\n    a: \"x\",\n}";
        let changes = settings(["1", "x", "12"]).changes(older).unwrap();
        assert_eq!(changes, "another version of ccd wrote it");
    }
}
