//! The options of `ccd query`.

use super::help::{AFTER_HELP, after_long_help};
use crate::bodies::pair::BodiesArgs;
use crate::options::named::{question_parser, start_policy_parser};
use crate::options::numbers::{parse_nonnegative, parse_seconds, tolerance};
use crate::options::solver_kind::{BoundKind, OracleKind, ScheduleKind};
use crate::rows::resumable::RowRange;
use ccd_core::StartPolicy;
use ccd_core::limits::{DEFAULT_BUDGET, DEFAULT_TOLERANCE};
use ccd_tables::results::{self, Column};
use clap::Args;
use rigid_ccd::Question;
use std::path::PathBuf;
use std::time::Duration;

/// Find the first contact of two bodies, or their least distance, for each row of a table of motions
#[derive(Clone, Debug, Args)]
#[command(after_help = AFTER_HELP, after_long_help = after_long_help())]
pub(crate) struct QueryArgs {
    #[command(flatten)]
    pub(super) bodies: BodiesArgs,
    /// Table of motions, or of paths if it has a column `t`, CSV or Parquet; - reads CSV from standard input
    #[arg(long, value_name = "TABLE")]
    pub(super) motions: PathBuf,
    /// Question that every row answers; all except first-contact need --schedule best-first
    #[arg(long, value_parser = question_parser(), default_value_t)]
    pub(super) question: Question,
    /// Distance that the bodies must keep, for --question closest-approach or distance: rows are then `kept`, `violated` or
    /// `unverified`; in the scene's unit of length
    #[arg(long, value_name = "LENGTH", value_parser = parse_nonnegative, allow_hyphen_values = true)]
    pub(super) clearance: Option<f64>,
    /// Distance backend: how the distance between two pieces is computed
    #[arg(long, value_enum, default_value_t)]
    pub(super) oracle: OracleKind,
    /// Order in which pairs of pieces are advanced
    #[arg(long, value_enum, default_value_t)]
    pub(super) schedule: ScheduleKind,
    /// Bound on the motion over a step of --schedule fast or naive [default: sound]
    #[arg(long, value_enum)]
    pub(super) bound: Option<BoundKind>,
    /// Report a contact at a distance of at most margin + tolerance, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value_t = DEFAULT_TOLERANCE, value_parser = tolerance, allow_hyphen_values = true)]
    pub(super) tolerance: f64,
    /// Distance to keep between the bodies, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = parse_nonnegative, allow_hyphen_values = true)]
    pub(super) margin: f64,
    /// How to treat bodies in contact at the start
    #[arg(long, value_parser = start_policy_parser(), default_value = "report")]
    pub(super) start: StartPolicy,
    /// Leave a query unresolved after N units of work (pairs of nodes visited, and work of equal cost), and a path
    /// after N units between two of its poses; a million takes about a second
    #[arg(long, value_name = "N", default_value_t = DEFAULT_BUDGET,
          value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) budget: u64,
    /// Leave a query unresolved after this time, in seconds [default: none]
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds, allow_hyphen_values = true)]
    pub(super) deadline: Option<Duration>,
    /// Number of threads; it changes no answer, and 1 gives the most accurate `micros` [default: all
    /// cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    /// Answer only these rows, numbered from 0, TO excluded; either end may be omitted
    #[arg(
        long,
        value_name = "FROM..TO",
        default_value = "..",
        hide_default_value = true
    )]
    pub(super) rows: RowRange,
    /// Repeat each query N times and report the median time
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(super) repeat: u32,
    /// Write the table of results to this file, CSV; - writes to standard output
    #[arg(long, value_name = "CSV", default_value = "-")]
    pub(super) out: PathBuf,
    /// Write a table of all pairs of features in contact to this file, CSV; - writes to standard
    /// output, and needs --out FILE
    #[arg(long, value_name = "CSV")]
    pub(super) contacts: Option<PathBuf>,
    /// Write an HTML page to this file with pictures of some rows: up to 4 of each status, or the rows of --html-ids
    #[arg(long, value_name = "HTML")]
    pub(super) html: Option<PathBuf>,
    /// Write machine-checkable proofs of the answers to this folder: ROW-ID.proof for each row that is free, or free until it
    /// touches or a limit is reached; `ccd check` checks them
    #[arg(long, value_name = "FOLDER")]
    pub(super) certificates: Option<PathBuf>,
    /// Show the rows with these ids on the page
    #[arg(long, value_name = "ID,...", value_delimiter = ',', requires = "html")]
    pub(super) html_ids: Vec<String>,
    /// Add columns with counters to the table of results, and print their means
    #[arg(long)]
    pub(super) counters: bool,
    /// Leave column `micros` empty, so that equal answers give equal files
    #[arg(long)]
    pub(super) no_micros: bool,
    /// Continue an interrupted run of the same command after its last complete row; a finished run
    /// is left unchanged
    #[arg(long)]
    pub(super) resume: bool,
    /// End with exit code 3 unless every row is `free` or, with --clearance, `kept`
    #[arg(long)]
    pub(super) check: bool,
    /// Print only warnings and errors on standard error: no progress, remarks or summary
    #[arg(long, short)]
    pub(super) quiet: bool,
}

impl QueryArgs {
    /// Returns the columns of the table of results that these options ask for.
    pub(super) fn columns(&self) -> Vec<Column> {
        let mut columns = results::columns(self.question);
        if self.counters {
            columns.extend(results::COUNTER_COLUMNS);
        }
        columns
    }
}

/// The ids of the options that the journal does not record as they are given. Most of them change no byte of the
/// tables. The journal has a checksum of the motions instead of their path, and one form of `--rows` instead of
/// several.
pub(super) const UNRECORDED_OPTIONS: [&str; 9] = [
    "motions", "threads", "out", "html", "html_ids", "resume", "check", "quiet", "rows",
];
