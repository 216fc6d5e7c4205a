//! How a run over the rows of a table ended.

use super::journal::Checkpoint;
use super::run_files::RunFiles;
use crate::{RunOutcome, print_error};

/// Returns how a run ended, and prints how many rows fail `--check`, if it is given.
pub(crate) fn report_outcome(files: &RunFiles<'_>, end: Checkpoint) -> RunOutcome {
    let counts = end.counts.nonzero_counts();
    let failed = counts.filter(|(status, _)| !status.proves_distance_kept());
    let failed: usize = failed.map(|(_, count)| count).sum();
    if files.check && failed > 0 {
        let rows = end.counts.row_count();
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
