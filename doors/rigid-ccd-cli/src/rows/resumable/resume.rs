//! `--resume`: skips the rows that an earlier run answered.

use super::batches::RowSource;
use super::journal::Checkpoint;
use super::run_files::RunFiles;
use crate::console::print_error;
use crate::files::input_name;
use anyhow::{Context, Result, bail};

/// Prints at which row a resumed run continues, or that it found no interrupted run.
pub(crate) fn report(files: &RunFiles<'_>, earlier: Option<Checkpoint>) {
    match earlier {
        Some(_) if files.quiet => {}
        Some(Checkpoint { rows, .. }) => {
            let input = input_name(files.input);
            print_error(&format!("--resume: continues at row {rows} of {input}"));
        }
        None => print_error("--resume: found no interrupted run; starts at the first row"),
    }
}

/// Skips the rows before the first one to answer, and returns the checkpoint at which the run starts. A resumed run
/// refuses a table whose skipped rows have changed.
pub(crate) fn skip_rows(
    files: &RunFiles<'_>,
    source: &mut impl RowSource,
    earlier: Option<Checkpoint>,
) -> Result<Checkpoint> {
    let input = || input_name(files.input);
    let count = earlier.map_or(files.rows.start, |earlier| earlier.rows);
    let skipped = source.skip_rows(count).with_context(input)?;
    let checksum = source.checksum();
    match earlier {
        Some(earlier) if (skipped, checksum) != (earlier.rows, earlier.checksum) => bail!(
            "--resume: {}: not the rows of the interrupted run; give the same table, or delete \
             {}.partial to start over",
            input(),
            files.out.display()
        ),
        Some(earlier) => Ok(earlier),
        None => Ok(Checkpoint {
            rows: skipped,
            checksum,
            ..Checkpoint::default()
        }),
    }
}

/// Refuses a table that differs from the table of a finished run; for the same table, prints that nothing is left to do.
pub(crate) fn check_finished(
    files: &RunFiles<'_>,
    source: &mut impl RowSource,
    end: Checkpoint,
) -> Result<()> {
    let (input, out) = (input_name(files.input), files.out.display());
    let skipped = source.skip_rows(end.rows).with_context(|| input.clone())?;
    let is_same_table = (skipped, source.checksum()) == (end.rows, end.checksum);
    let may_have_more = files.rows.end_row.is_none_or(|last| end.rows < last);
    if !is_same_table || may_have_more && source.skip_rows(1).with_context(|| input.clone())? > 0 {
        bail!(
            "--resume: {input}: not the rows of the finished run; give the same table, or omit \
             --resume to start over"
        );
    }
    if !files.quiet {
        print_error(&format!(
            "--resume: {out} already has all rows of this query; it is unchanged"
        ));
    }
    Ok(())
}
