//! The tables of results and contacts, new or continued from an earlier run.
//!
//! A [journal](super::journal) records the options and the last checkpoint. Rows after that checkpoint,
//! a half-written one for instance, are dropped when a run continues.

use super::journal::{Checkpoint, EarlierRun, Journal, JournalError};
use super::run_files::RunFiles;
use crate::files::output::{JOURNAL_EXTENSION, Output, OutputError};
use crate::files::table::{LengthAndChecksum, TableWriter, measure_beginning};
use crate::rows::contacts;
use anyhow::{Context, Result, bail};
use ccd_tables::results::names;
use std::fs::File;
use std::path::PathBuf;

/// The open tables of results and contacts, with their journal.
pub(crate) struct Outputs {
    pub(crate) results: TableWriter,
    pub(crate) contacts: Option<TableWriter>,
    journal: Option<Journal>,
}

/// The opened tables of a run; the variant says which rows are left to answer.
pub(crate) enum OpenedTables {
    /// New tables, or the tables of an interrupted run with the same options. The rows after its checkpoint are left to answer.
    Unfinished(Box<Outputs>, Option<Checkpoint>),
    /// The tables of a finished run with the same options. No row is left to answer.
    Finished(Checkpoint),
}

/// The reserved files of the tables of results and contacts, before anything is written.
pub(crate) struct ClaimedFiles {
    results: Output,
    contacts: Option<Output>,
}

impl ClaimedFiles {
    /// Reserves the files of the table of results and, if `--contacts` is given, of the table of contacts.
    pub(crate) fn claim(files: &RunFiles<'_>) -> Result<Self> {
        // The first failure ends this: otherwise two runs that claim the same files could refuse each other.
        let results = Output::claim(files.out)?;
        let contacts = files.contacts.map(Output::claim_table).transpose()?;
        let claimed = ClaimedFiles { results, contacts };
        let streams = [Some(&claimed.results), claimed.contacts.as_ref()];
        if files.resume && streams.into_iter().flatten().any(Output::is_stream) {
            bail!("--resume needs files; give --out (and --contacts) a file name");
        }
        Ok(claimed)
    }
}

impl OpenedTables {
    /// Creates the tables, or opens the tables of an earlier run with the same options.
    pub(crate) fn new(files: &RunFiles<'_>, claimed: ClaimedFiles, options: &str) -> Result<Self> {
        let Some(results) = &claimed.results.reserved_file else {
            let outputs = Outputs::create(files, claimed, options, None)?;
            return Ok(OpenedTables::Unfinished(Box::new(outputs), None));
        };
        let journal = results.sibling(JOURNAL_EXTENSION);
        let earlier = match EarlierRun::read(&journal) {
            Ok(earlier) => earlier,
            Err(JournalError) if results.initial_length() > 0 => bail!(
                "{} holds rows of an interrupted run, but its record {} is missing or damaged; delete the \
                 first to start over",
                results.partial_path().display(),
                journal.display()
            ),
            Err(JournalError) => None,
        };
        let mut claimed = claimed;
        if files.resume
            && let Some(finished) = &earlier
            && finished.checkpoint.finished
        {
            if claimed.rename_finished_tables(finished, options)? {
                return Ok(OpenedTables::Finished(finished.checkpoint));
            }
            claimed = ClaimedFiles::claim(files)?;
        }
        claimed.create_or_resume_tables(files, options, (earlier, journal))
    }
}

impl ClaimedFiles {
    /// Continues the tables of an interrupted run, or creates new tables if there was no such run.
    fn create_or_resume_tables(
        self,
        files: &RunFiles<'_>,
        options: &str,
        (earlier, journal): (Option<EarlierRun>, PathBuf),
    ) -> Result<OpenedTables> {
        let partial_results = self
            .results
            .reserved_file
            .as_ref()
            .filter(|results| results.initial_length() > 0);
        match earlier.zip(partial_results) {
            Some((earlier, results)) if files.resume => {
                let rows = results.partial_path().display().to_string();
                let advice = format!("delete {rows} to start over");
                refuse_changed_options(&earlier, options, "interrupted", &advice)?;
                let outputs = Outputs::resume(self, &earlier.checkpoint, options, journal)?;
                Ok(OpenedTables::Unfinished(
                    Box::new(outputs),
                    Some(earlier.checkpoint),
                ))
            }
            Some((earlier, results)) if earlier.checkpoint.counts.row_count() > 0 => bail!(
                "{} has {} rows of an interrupted run; add --resume to continue it, or delete the file \
                 to start over",
                results.partial_path().display(),
                earlier.checkpoint.counts.row_count()
            ),
            _ => {
                let outputs = Outputs::create(files, self, options, Some(journal))?;
                Ok(OpenedTables::Unfinished(Box::new(outputs), None))
            }
        }
    }

    /// Renames the tables of a finished run that still have a temporary name. Returns whether all its tables exist.
    fn rename_finished_tables(self, run: &EarlierRun, options: &str) -> Result<bool> {
        let Checkpoint {
            results, contacts, ..
        } = run.checkpoint;
        if !rename_complete_table(self.results, results)? {
            return Ok(false);
        }
        refuse_changed_options(run, options, "finished", "omit --resume to start over")?;
        self.contacts
            .map_or(Ok(true), |table| rename_complete_table(table, contacts))
    }
}

/// Renames a complete table to its final name, unless the table already has that name. Returns whether a file of that
/// name exists.
fn rename_complete_table(table: Output, written: LengthAndChecksum) -> Result<bool> {
    let Some(mut claim) = table.reserved_file else {
        return Ok(true);
    };
    let target = claim.target().to_owned();
    let rename_and_check = || {
        if claim.initial_length() == written.bytes
            && measure_beginning(claim.file(), u64::MAX)?.length_and_checksum() == written
        {
            claim.rename_to_target()?;
        }
        if !target.exists() {
            return Ok(None);
        }
        let measured = measure_beginning(File::open(&target)?, u64::MAX)?;
        Ok(Some(measured.length_and_checksum() == written))
    };
    match rename_and_check().map_err(|source| OutputError::error_for_path(&target, source))? {
        Some(false) => bail!(
            "--resume: {} has changed since the run finished; omit --resume to start over and \
             overwrite it",
            target.display()
        ),
        unchanged => Ok(unchanged.is_some()),
    }
}

/// Returns an error if the options differ from the options of the earlier run.
fn refuse_changed_options(
    earlier: &EarlierRun,
    options: &str,
    run: &str,
    advice: &str,
) -> Result<()> {
    match earlier.describe_changes(options) {
        Some(changes) => bail!(
            "--resume: the {run} run had other options: {changes}; give the same options, or {advice}"
        ),
        None => Ok(()),
    }
}

impl Outputs {
    fn resume(
        claimed: ClaimedFiles,
        from: &Checkpoint,
        options: &str,
        journal: PathBuf,
    ) -> Result<Self> {
        let contacts = (claimed.contacts).map(|table| resume_table(table, from.contacts));
        Ok(Outputs {
            contacts: contacts.transpose()?,
            results: resume_table(claimed.results, from.results)?,
            journal: Some(Journal::start(journal, options, Some(from))?),
        })
    }

    fn create(
        files: &RunFiles<'_>,
        claimed: ClaimedFiles,
        options: &str,
        journal: Option<PathBuf>,
    ) -> Result<Self, OutputError> {
        // This comes first, because the journal of an earlier run does not describe these tables.
        let journal = journal
            .map(|path| Journal::start(path, options, None))
            .transpose()?;
        let results = TableWriter::start(claimed.results, &files.header)?;
        let header = names(&contacts::columns());
        let contacts = (claimed.contacts).map(|place| TableWriter::start(place, &header));
        Ok(Outputs {
            results,
            contacts: contacts.transpose()?,
            journal,
        })
    }

    /// Flushes the tables, and appends a checkpoint to the journal.
    pub(crate) fn save(&mut self, mut checkpoint: Checkpoint) -> Result<(), OutputError> {
        checkpoint.results = self.results.flush_and_measure()?;
        if let Some(contacts) = &mut self.contacts {
            checkpoint.contacts = contacts.flush_and_measure()?;
        }
        let journal = self.journal.as_mut();
        journal.map_or(Ok(()), |journal| journal.append(checkpoint))
    }

    /// Renames the complete tables to their final names.
    pub(crate) fn finish(mut self, checkpoint: Checkpoint) -> Result<(), OutputError> {
        // A run that is resumed after this point only renames the tables.
        self.save(Checkpoint {
            finished: true,
            ..checkpoint
        })?;
        self.results.finish()?;
        self.contacts.map_or(Ok(()), TableWriter::finish)
    }
}

/// Opens a table of an interrupted run, to append to it.
fn resume_table(table: Output, written: LengthAndChecksum) -> Result<TableWriter> {
    let Some(claim) = &table.reserved_file else {
        bail!("--resume needs files");
    };
    let partial = claim.partial_path().display().to_string();
    let table = TableWriter::resume(table, written)?;
    table.with_context(|| {
        format!(
            "--resume: {partial} is not as the interrupted run left it; delete it to start over"
        )
    })
}
