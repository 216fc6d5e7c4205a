//! `ccd query --resume`: skips the rows that an earlier run answered.

use super::args::QueryArgs;
use super::journal::Checkpoint;
use super::summary::Summary;
use super::{print_summary, report_run_outcome};
use crate::files::{Rows, input_name};
use crate::{RunOutcome, print_error};
use anyhow::{Context, Result, bail};

/// Prints at which row a resumed run continues, or that it found no interrupted run.
pub(super) fn report(args: &QueryArgs, earlier: Option<Checkpoint>) {
    if earlier.is_some() {
        warn_of_partial_page(args);
    }
    match earlier {
        Some(_) if args.quiet => {}
        Some(Checkpoint { rows, .. }) => {
            print_error(&format!("--resume: continues at row {rows} of the motions"));
        }
        None => print_error("--resume: found no interrupted run; starts at the first row"),
    }
}

/// Skips the rows before the first one to answer, and returns the checkpoint at which the run starts. A resumed run
/// refuses a table whose skipped rows have changed.
pub(super) fn skip_rows(
    args: &QueryArgs,
    rows: &mut Rows,
    earlier: Option<Checkpoint>,
) -> Result<Checkpoint> {
    let input = || input_name(&args.motions);
    let wanted = earlier.map_or(args.rows.start, |earlier| earlier.rows);
    let skipped = rows.skip_rows(wanted).with_context(input)?;
    let checksum = rows.checksum();
    match earlier {
        Some(earlier) if (skipped, checksum) != (earlier.rows, earlier.checksum) => bail!(
            "--resume: {}: not the rows of the interrupted run; give the same table, or delete \
             {}.partial to start over",
            input(),
            args.out.display()
        ),
        Some(earlier) => Ok(earlier),
        None => Ok(Checkpoint {
            rows: skipped,
            checksum,
            ..Checkpoint::default()
        }),
    }
}

/// Warns, if `--html` is given, that the page of a resumed run shows only the rows answered in this run.
fn warn_of_partial_page(args: &QueryArgs) {
    if args.html.is_some() {
        print_error(
            "--html: shows the rows that this run answers; `ccd view --results` shows those of earlier ones",
        );
    }
}

/// Reports that a finished run has nothing left to do, and returns its exit status. Refuses motions that are not those
/// of the finished run.
pub(super) fn verify_and_report_finished(
    args: &QueryArgs,
    rows: &mut Rows,
    end: Checkpoint,
) -> Result<RunOutcome> {
    warn_of_partial_page(args);
    let (input, out) = (input_name(&args.motions), args.out.display());
    let skipped = rows.skip_rows(end.rows).with_context(|| input.clone())?;
    let same = (skipped, rows.checksum()) == (end.rows, end.checksum);
    let more = args.rows.end_row.is_none_or(|last| end.rows < last);
    if !same || more && rows.skip_rows(1).with_context(|| input.clone())? > 0 {
        bail!(
            "--resume: {input}: not the rows of the finished run; give the same table, or omit \
             --resume to start over"
        );
    }
    if !args.quiet {
        print_error(&format!(
            "--resume: {out} already has all rows of this query; it is unchanged"
        ));
        print_summary(
            args,
            &Summary::new(args.tolerance).with_earlier_counts(end.counts),
        );
    }
    Ok(report_run_outcome(args, end))
}
