//! Where results and contacts go, and what an earlier run has left of them.
//!
//! Beside the tables a [journal](super::journal) says with what options they were begun and how far they
//! have come. What stands in the tables behind that, a half-written row for instance, is dropped when a
//! run goes on.

use super::args::QueryArgs;
use super::journal::{Journal, Left, Mark, Settings};
use crate::command::files::CannotWrite;
use crate::command::files::{Beside, RESUME, Table};
use crate::table::contacts;
use crate::table::results;
use anyhow::{Result, bail};
use std::path::{Path, PathBuf};

/// The tables of a run.
pub(super) struct Outputs {
    pub(super) results: Table,
    pub(super) contacts: Option<Table>,
    journal: Option<Journal>,
}

/// What there is to do.
pub(super) enum Opened {
    /// All rows.
    Begun(Outputs),
    /// Those behind the ones that an interrupted run of the same settings came to.
    GoesOn(Outputs, Mark),
    /// Nothing: a run of the same settings has finished.
    Whole(Mark),
}

/// Where the parts of the tables are that are files.
struct Places {
    results: Option<Beside>,
    contacts: Option<Beside>,
}

impl Opened {
    /// Begins tables, or goes on with those of a run of the same settings; says how far they are.
    pub(super) fn new(args: &QueryArgs, settings: &Settings) -> Result<Self> {
        let places = Places::find(args)?;
        let all = args.contacts.is_some() == places.contacts.is_some();
        if args.resume && !(all && places.results.is_some()) {
            bail!("--resume goes on with files; give --out (and --contacts) the name of one");
        }
        let Places {
            results: Some(results),
            contacts,
        } = places
        else {
            return Ok(Opened::Begun(Outputs::create(args, settings, None)?));
        };
        let journal = results.with_ending(RESUME);
        let left = Left::read(&journal);
        if let Some(whole) = left.as_ref().filter(|left| args.resume && left.mark.whole)
            && results.name_whole(whole.mark.results_bytes)?
        {
            refuse_other(
                whole,
                settings,
                "finished",
                "leave out --resume to begin again",
            )?;
            let contacts = contacts.as_ref();
            let named = contacts.map(|table| table.name_whole(whole.mark.contacts_bytes));
            if named.transpose()?.unwrap_or(true) {
                return Ok(Opened::Whole(whole.mark));
            }
        }
        match left.filter(|_| results.partial().exists()) {
            Some(left) if args.resume => {
                let advice = format!("delete {} to begin again", results.partial().display());
                refuse_other(&left, settings, "interrupted", &advice)?;
                let contacts = contacts
                    .map(|beside| Table::resume(beside, left.mark.contacts_bytes))
                    .transpose()?;
                let outputs = Outputs {
                    results: Table::resume(results, left.mark.results_bytes)?,
                    contacts,
                    journal: Some(left.continued(journal)?),
                };
                Ok(Opened::GoesOn(outputs, left.mark))
            }
            Some(left) if left.rows > 0 => bail!(
                "{} has {} rows of an interrupted run; --resume goes on behind them, to begin again \
                 delete it",
                results.partial().display(),
                left.rows
            ),
            _ => Ok(Opened::Begun(Outputs::create(
                args,
                settings,
                Some(journal),
            )?)),
        }
    }
}

/// Refuses to go on with other settings: rows of one table are answers to one question.
fn refuse_other(left: &Left, settings: &Settings, run: &str, advice: &str) -> Result<()> {
    match left.changes(settings) {
        Some(changes) => bail!(
            "--resume: the {run} run was asked something else: {changes}; ask the same, or {advice}"
        ),
        None => Ok(()),
    }
}

impl Places {
    fn find(args: &QueryArgs) -> Result<Self, CannotWrite> {
        let beside = |path: &Path| {
            Beside::find(path).map_err(|source| CannotWrite {
                place: path.display().to_string(),
                source,
            })
        };
        let contacts = args.contacts.as_deref();
        Ok(Places {
            results: beside(&args.out)?,
            contacts: contacts.map(beside).transpose()?.flatten(),
        })
    }
}

impl Outputs {
    fn create(
        args: &QueryArgs,
        settings: &Settings,
        journal: Option<PathBuf>,
    ) -> Result<Self, CannotWrite> {
        // First of all, as the one of an earlier run says nothing of these tables.
        let journal = journal
            .map(|path| Journal::create(path, settings))
            .transpose()?;
        let results = Table::create(&args.out, &results::columns(args.extent()))?;
        let contacts = args.contacts.as_deref();
        let contacts = contacts.map(|path| Table::create(path, &contacts::COLUMNS));
        let contacts = contacts.transpose()?;
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
    pub(super) fn finish(mut self, mark: Mark) -> Result<(), CannotWrite> {
        // Whoever goes on behind here has but the names to give.
        self.keep(Mark {
            whole: true,
            ..mark
        })?;
        self.results.finish()?;
        match self.contacts {
            Some(contacts) => contacts.finish(),
            None => Ok(()),
        }
    }
}
