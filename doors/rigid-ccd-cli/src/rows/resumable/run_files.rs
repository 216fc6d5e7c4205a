//! The files of a run over the rows of a table.

use super::row_range::RowRange;
use std::path::Path;

/// The files of a run, and how it uses them.
#[derive(Clone, Debug)]
pub(crate) struct RunFiles<'a> {
    /// The table of motions, edges or paths; `-` for standard input.
    pub(crate) input: &'a Path,
    /// The rows of the input that are answered.
    pub(crate) rows: RowRange,
    /// The table of results; `-` for standard output.
    pub(crate) out: &'a Path,
    /// The names of the columns of the results.
    pub(crate) header: Vec<&'static str>,
    /// The table of contacts; `None` without `--contacts`.
    pub(crate) contacts: Option<&'a Path>,
    /// Whether an earlier run is continued.
    pub(crate) resume: bool,
    /// Whether rows that are not proven free or kept fail the run.
    pub(crate) check: bool,
    /// Whether only warnings and errors are printed.
    pub(crate) quiet: bool,
}
