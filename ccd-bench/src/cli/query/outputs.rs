//! Where results and contacts go, and what an interrupted run leaves for the next one.
//!
//! Beside the parts of the tables there is a file that says with what options they were begun and, once
//! for each batch of rows, how far they have come. What stands in the tables behind that, a half-written
//! row for instance, is dropped when a run goes on.

use super::args::QueryArgs;
use crate::cli::CannotWrite;
use crate::cli::files::{Beside, RESUME, Table};
use crate::contacts;
use crate::results;
use anyhow::{Result, bail};
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The tables of a run.
pub(super) struct Outputs {
    pub(super) results: Table,
    pub(super) contacts: Option<Table>,
    journal: Option<Journal>,
}

/// How far a run has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Mark {
    /// Rows of motions that are done with, all before the first one asked for included.
    pub(super) rows: usize,
    /// The checksum of these.
    pub(super) checksum: u32,
    /// How many of them have no complete answer.
    pub(super) bad: usize,
    /// How long the tables are: known once they are handed on.
    pub(super) results_bytes: u64,
    pub(super) contacts_bytes: u64,
}

/// The file of the options and the marks.
struct Journal {
    path: PathBuf,
    file: File,
}

/// Stands in the journal between the options and the marks.
const MARKS: &str = "\nmarks:\n";

impl Outputs {
    /// Begins tables, or goes on with those of a run of the same settings; says how far they are.
    pub(super) fn open(args: &QueryArgs, settings: &str) -> Result<(Self, Option<Mark>)> {
        let cannot = |path: &Path| {
            let place = path.display().to_string();
            |source| CannotWrite { place, source }
        };
        let results = Beside::find(&args.out).map_err(cannot(&args.out))?;
        let contacts = args.contacts.as_deref();
        let beside = |path: &Path| Beside::find(path).map_err(cannot(path));
        let contacts_beside = contacts.map(beside).transpose()?.flatten();
        if args.resume && (results.is_none() || contacts.is_some() != contacts_beside.is_some()) {
            bail!("--resume goes on with files; give --out (and --contacts) the name of one");
        }
        let journal = results.as_ref().map(|results| results.with_ending(RESUME));
        let left = match (&results, &journal) {
            (Some(results), Some(journal)) if results.partial().exists() => Left::read(journal),
            _ => None,
        };
        match (left, results, journal) {
            (Some(left), Some(results), Some(path)) if args.resume => {
                left.check(settings)?;
                let file = left.continued(&path).map_err(cannot(&path))?;
                let contacts = contacts_beside
                    .map(|beside| Table::resume(beside, left.mark.contacts_bytes))
                    .transpose()?;
                let outputs = Outputs {
                    results: Table::resume(results, left.mark.results_bytes)?,
                    contacts,
                    journal: Some(Journal { path, file }),
                };
                Ok((outputs, Some(left.mark)))
            }
            (Some(left), Some(results), _) if left.rows > 0 => bail!(
                "{} has {} rows of an interrupted run; --resume goes on behind them, to begin again \
                 delete it",
                results.partial().display(),
                left.rows
            ),
            (_, _, journal) => Ok((Outputs::create(args, settings, journal)?, None)),
        }
    }

    fn create(
        args: &QueryArgs,
        settings: &str,
        journal: Option<PathBuf>,
    ) -> Result<Self, CannotWrite> {
        let results = Table::create(&args.out, &results::columns(args.extent()))?;
        let contacts = args.contacts.as_deref();
        let contacts = contacts.map(|path| Table::create(path, &contacts::COLUMNS));
        let contacts = contacts.transpose()?;
        let journal = journal
            .map(|path| Journal::create(path, settings))
            .transpose()?;
        Ok(Outputs {
            results,
            contacts,
            journal,
        })
    }

    /// Hands on what has been written, and notes how far that is.
    pub(super) fn keep(&mut self, mut mark: Mark) -> Result<(), CannotWrite> {
        mark.results_bytes = self.results.flush()?;
        if let Some(contacts) = &mut self.contacts {
            mark.contacts_bytes = contacts.flush()?;
        }
        match &mut self.journal {
            Some(journal) => journal.note(mark),
            None => Ok(()),
        }
    }

    /// Gives the tables their names: they are whole.
    pub(super) fn finish(self) -> Result<(), CannotWrite> {
        self.results.finish()?;
        if let Some(contacts) = self.contacts {
            contacts.finish()?;
        }
        if let Some(journal) = self.journal {
            // Without the tables' parts it means nothing.
            let _ = fs::remove_file(journal.path);
        }
        Ok(())
    }
}

impl Journal {
    fn create(path: PathBuf, settings: &str) -> Result<Self, CannotWrite> {
        let create = || {
            let mut file = File::create(&path)?;
            write!(file, "{settings}{MARKS}")?;
            Ok(file)
        };
        match create() {
            Ok(file) => Ok(Journal { path, file }),
            Err(source) => Err(Journal::failed(&path, source)),
        }
    }

    fn note(&mut self, mark: Mark) -> Result<(), CannotWrite> {
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

/// What an interrupted run has left.
struct Left {
    settings: String,
    /// How many rows it answered.
    rows: usize,
    mark: Mark,
    /// How much of the journal is whole.
    bytes: u64,
}

impl Left {
    /// None when it did not come to its first mark.
    fn read(journal: &Path) -> Option<Self> {
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

    /// Refuses to go on with other settings: rows of one table are answers to one question.
    fn check(&self, settings: &str) -> Result<()> {
        let mut lines = self.settings.lines().zip(settings.lines());
        match lines.find(|(then, now)| then != now) {
            Some((then, now)) => bail!(
                "--resume: the interrupted run was told otherwise: `{}`, not `{}`; tell the same, or \
                 delete what it left to begin again",
                then.trim(),
                now.trim()
            ),
            None => Ok(()),
        }
    }

    fn continued(&self, journal: &Path) -> io::Result<File> {
        let file = File::options().append(true).open(journal)?;
        file.set_len(self.bytes)?;
        Ok(file)
    }
}
