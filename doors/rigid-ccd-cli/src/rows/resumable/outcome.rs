//! How a run over the rows of a table ended.

use super::journal::Checkpoint;
use super::run_files::RunFiles;
use crate::console::{RunOutcome, print_error};
use crate::files::input_name;

/// Returns how a run ended. With `--check`, prints how many rows are not proven, and takes a table without rows as bad input,
/// because it proves nothing.
pub(crate) fn report_outcome(files: &RunFiles<'_>, end: Checkpoint) -> RunOutcome {
    let rows = end.counts.row_count();
    let counts = end.counts.nonzero_counts();
    let failed = counts.filter(|(status, _)| !status.proves_distance_kept());
    let failed: usize = failed.map(|(_, count)| count).sum();
    if files.check && rows == 0 {
        print_error("--check: no row is answered");
        return RunOutcome::SomeRowsBad;
    }
    if files.check && failed > 0 {
        print_error(&format!(
            "--check: {failed} of {rows} rows are not proven free or kept"
        ));
    }
    match (end.bad_rows, failed) {
        (0, 1..) if files.check => RunOutcome::SomeRowsUnproven,
        (0, _) => RunOutcome::AllAnswered,
        _ => RunOutcome::SomeRowsBad,
    }
}

/// Warns that the table has no row to answer, after it was read from `start` to its end.
pub(crate) fn warn_of_no_rows(files: &RunFiles<'_>, start: Checkpoint) {
    let input = input_name(files.input);
    if files.rows.includes_all_rows() {
        print_error(&format!("{input}: has a header, but no rows"));
    } else {
        print_error(&format!(
            "{input}: has {} rows, and --rows {} selects none of them",
            start.rows, files.rows
        ));
    }
}
