//! Runs over the rows of a table, whose results are saved batch by batch, so that an interrupted run can be continued.

mod batches;
mod journal;
mod outcome;
mod outputs;
mod resume;
mod row_range;
mod run_files;

pub(super) use batches::{Batches, RowSource, answer_in_batches};
pub(super) use journal::{Checkpoint, FILE_CHECKSUM_PREFIX, option_values, options_text};
pub(super) use outcome::{report_outcome, warn_of_no_rows};
pub(super) use outputs::{ClaimedFiles, OpenedTables, Outputs};
pub(super) use resume::{check_finished, report, skip_rows};
pub(super) use row_range::RowRange;
pub(super) use run_files::RunFiles;
