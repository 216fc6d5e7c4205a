//! Runs over the rows of a table, whose results are saved batch by batch, so that an interrupted run can be continued.

mod batches;
mod journal;
mod outcome;
mod outputs;
mod resume;
mod row_range;
mod run_files;

pub(crate) use batches::{Batches, RowSource, answer_in_batches};
pub(crate) use journal::{Checkpoint, FILE_CHECKSUM_PREFIX, option_values, options_text};
pub(crate) use outcome::{report_outcome, warn_of_no_rows};
pub(crate) use outputs::{ClaimedFiles, OpenedTables, Outputs};
pub(crate) use resume::{check_finished, report, skip_rows};
pub(crate) use row_range::RowRange;
pub(crate) use run_files::RunFiles;
