//! The tables of results and contacts, new or continued from an earlier run.
//!
//! A [journal](super::journal) records the options and the last checkpoint. Rows after that checkpoint,
//! a half-written one for instance, are dropped when a run continues.

use super::args::QueryArgs;
use super::journal::{Checkpoint, Earlier, Journal, Lost, Recorded};
use crate::command::files::CannotWrite;
use crate::command::files::{PendingFile, RESUME, Table};
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

/// The tables of a run, and the rows left to answer.
pub(super) enum Opened {
    /// New tables: all rows.
    New(Outputs),
    /// The tables of an interrupted run with the same options: the rows after this checkpoint.
    Resumed(Outputs, Checkpoint),
    /// The tables of a finished run with the same options: no rows.
    Finished(Checkpoint),
}

/// The tables that are files; none where an output is a stream.
struct PendingTables {
    results: Option<PendingFile>,
    contacts: Option<PendingFile>,
}

impl Opened {
    /// Creates the tables, or opens those of an earlier run with the same options.
    pub(super) fn new(args: &QueryArgs, recorded: &Recorded) -> Result<Self> {
        let pending = PendingTables::find(args)?;
        let all = args.contacts.is_some() == pending.contacts.is_some();
        if args.resume && !(all && pending.results.is_some()) {
            bail!("--resume needs files; give --out (and --contacts) a file name");
        }
        let PendingTables {
            results: Some(results),
            contacts,
        } = pending
        else {
            return Ok(Opened::New(Outputs::create(args, recorded, None)?));
        };
        let journal = results.sibling(RESUME);
        let earlier = match Earlier::read(&journal) {
            Ok(earlier) => earlier,
            Err(Lost) if results.partial().exists() => bail!(
                "{} holds rows of an interrupted run, but its record {} is missing or damaged; delete the \
                 first to start over",
                results.partial().display(),
                journal.display()
            ),
            Err(Lost) => None,
        };
        if let Some(finished) = earlier
            .as_ref()
            .filter(|earlier| args.resume && earlier.checkpoint.finished)
            && results.give_final_name(finished.checkpoint.results_bytes)?
        {
            check_options(
                finished,
                recorded,
                "finished",
                "omit --resume to start over",
            )?;
            let contacts = contacts.as_ref();
            let named =
                contacts.map(|table| table.give_final_name(finished.checkpoint.contacts_bytes));
            if named.transpose()?.unwrap_or(true) {
                return Ok(Opened::Finished(finished.checkpoint));
            }
        }
        match earlier.filter(|_| results.partial().exists()) {
            Some(earlier) if args.resume => {
                let advice = format!("delete {} to start over", results.partial().display());
                check_options(&earlier, recorded, "interrupted", &advice)?;
                let outputs = Outputs::resume(results, contacts, &earlier, journal)?;
                Ok(Opened::Resumed(outputs, earlier.checkpoint))
            }
            Some(earlier) if earlier.rows > 0 => bail!(
                "{} has {} rows of an interrupted run; add --resume to continue it, or delete the file \
                 to start over",
                results.partial().display(),
                earlier.rows
            ),
            _ => Ok(Opened::New(Outputs::create(args, recorded, Some(journal))?)),
        }
    }
}

/// Refuses to continue with other options: all rows of a table answer the same question.
fn check_options(earlier: &Earlier, recorded: &Recorded, run: &str, advice: &str) -> Result<()> {
    match earlier.changes(recorded) {
        Some(changes) => bail!(
            "--resume: the {run} run had other options: {changes}; give the same options, or {advice}"
        ),
        None => Ok(()),
    }
}

impl PendingTables {
    fn find(args: &QueryArgs) -> Result<Self, CannotWrite> {
        let pending = |path: &Path| {
            PendingFile::find(path).map_err(|source| CannotWrite {
                place: path.display().to_string(),
                source,
            })
        };
        let contacts = args.contacts.as_deref();
        Ok(PendingTables {
            results: pending(&args.out)?,
            contacts: contacts.map(pending).transpose()?.flatten(),
        })
    }
}

impl Outputs {
    fn resume(
        results: PendingFile,
        contacts: Option<PendingFile>,
        earlier: &Earlier,
        journal: PathBuf,
    ) -> Result<Self, CannotWrite> {
        let Checkpoint {
            results_bytes,
            contacts_bytes,
            ..
        } = earlier.checkpoint;
        let contacts = contacts.map(|file| Table::resume(file, contacts_bytes));
        Ok(Outputs {
            contacts: contacts.transpose()?,
            results: Table::resume(results, results_bytes)?,
            journal: Some(earlier.reopen(journal)?),
        })
    }

    fn create(
        args: &QueryArgs,
        recorded: &Recorded,
        journal: Option<PathBuf>,
    ) -> Result<Self, CannotWrite> {
        // First of all: the journal of an earlier run does not describe these tables.
        let journal = journal
            .map(|path| Journal::create(path, recorded))
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

    /// Flushes the tables, and appends a checkpoint to the journal.
    pub(super) fn save(&mut self, mut checkpoint: Checkpoint) -> Result<(), CannotWrite> {
        checkpoint.results_bytes = self.results.flush()?;
        if let Some(contacts) = &mut self.contacts {
            checkpoint.contacts_bytes = contacts.flush()?;
        }
        match &mut self.journal {
            Some(journal) => journal.append(checkpoint),
            None => Ok(()),
        }
    }

    /// Gives the tables their final names.
    pub(super) fn finish(mut self, checkpoint: Checkpoint) -> Result<(), CannotWrite> {
        // A run that is resumed after this only renames the tables.
        self.save(Checkpoint {
            finished: true,
            ..checkpoint
        })?;
        self.results.finish()?;
        match self.contacts {
            Some(contacts) => contacts.finish(),
            None => Ok(()),
        }
    }
}
