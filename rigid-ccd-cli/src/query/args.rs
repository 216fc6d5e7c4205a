//! The options of `ccd query`.

use super::help::{AFTER_HELP, AFTER_LONG_HELP};
use crate::named::{
    QUESTIONS, SHORTCUTS, SIMD_INSTRUCTION_SETS, START_POLICIES, named_value_parser,
};
use crate::numbers::{parse_nonnegative, parse_seconds, tolerance};
use crate::pair::BodiesArgs;
use crate::solver_kind::{BoundKind, OracleKind, ScheduleKind};
use ccd_core::limits::{DEFAULT_BUDGET, DEFAULT_TOLERANCE};
use ccd_core::schedule::Shortcut;
use ccd_core::{StartPolicy, VectorInstructions};
use clap::{ArgMatches, Args, Command};
use rigid_ccd::batch::Question;
use rigid_ccd::table::results::{self, Column};
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

/// Find the first contact of two bodies, or their least distance, for each row of a table of motions
#[derive(Clone, Debug, Args)]
#[command(after_help = AFTER_HELP, after_long_help = AFTER_LONG_HELP)]
pub(crate) struct QueryArgs {
    #[command(flatten)]
    pub(super) bodies: BodiesArgs,
    /// Table of motions to read, CSV, or of paths if it has a column `t`; - reads standard input
    #[arg(long, value_name = "CSV")]
    pub(super) motions: PathBuf,
    /// Question that every row answers; all except first-contact need --schedule best-first
    #[arg(long, value_parser = named_value_parser(QUESTIONS), default_value_t)]
    pub(super) ask: Question,
    /// Distance that the bodies must keep, for --ask closest-approach or distance: rows are then `kept`, `violated` or
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
    #[arg(long, value_parser = named_value_parser(START_POLICIES), default_value = "report")]
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
    /// Vector instructions to compute with; they change the speed, not the answers
    #[arg(long, value_parser = named_value_parser(SIMD_INSTRUCTION_SETS), default_value = "best")]
    pub(super) instructions: VectorInstructions,
    /// Search without these shortcuts, to see what they save; times stay certified
    #[arg(long, value_name = "SHORTCUT,...", value_delimiter = ',', value_parser = named_value_parser(SHORTCUTS))]
    pub(super) without: Vec<Shortcut>,
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
    /// Write an HTML page to this file with pictures of some rows: up to 4 of each status, or those of --html-ids
    #[arg(long, value_name = "HTML")]
    pub(super) html: Option<PathBuf>,
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
        let mut columns = results::columns(self.ask);
        if self.counters {
            columns.extend(results::COUNTER_COLUMNS);
        }
        columns
    }

    /// Returns the options that determine the tables, with their values as given or by default.
    pub(super) fn recorded_options(&self, given: &ArgMatches) -> Vec<(String, String)> {
        let all = QueryArgs::augment_args(Command::new("query"));
        let options = all.get_arguments().filter(|option| {
            let id = option.get_id().as_str();
            !UNRECORDED_OPTIONS.contains(&id)
        });
        let recorded = options.map(|option| {
            let values = given
                .get_raw(option.get_id().as_str())
                .into_iter()
                .flatten();
            let values: Vec<_> = values.map(|value| value.to_string_lossy()).collect();
            let value = match values.join(",") {
                none if none.is_empty() => "not given".to_owned(),
                values => values,
            };
            let name = option.get_long().unwrap_or_default();
            (format!("--{name}"), value)
        });
        recorded
            .chain([("--rows".to_owned(), self.rows.to_string())])
            .collect()
    }
}

/// The ids of the options that the journal does not record as they are given. Most of them change no byte of the
/// tables. The journal has a checksum of the motions instead of their path, and one form of `--rows` instead of
/// several.
const UNRECORDED_OPTIONS: [&str; 10] = [
    "motions",
    "threads",
    "instructions",
    "out",
    "html",
    "html_ids",
    "resume",
    "check",
    "quiet",
    "rows",
];

/// A range of rows of a table, numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct RowRange {
    /// The number of the first row of the range.
    pub(super) start: usize,
    /// The number of the row after the range; `None` for a range without an end.
    pub(super) end_row: Option<usize>,
}

impl RowRange {
    pub(super) fn includes_all_rows(self) -> bool {
        self.start == 0 && self.end_row.is_none()
    }
}

impl FromStr for RowRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bound = |text: &str, absent| match text {
            "" => Ok(absent),
            number => number.parse().map(Some).map_err(|_| ()),
        };
        let range = text.split_once("..").and_then(|(start, end)| {
            let start = bound(start, Some(0)).ok()??;
            let end = bound(end, None).ok()?;
            Some(RowRange {
                start,
                end_row: end,
            })
        });
        range
            .filter(|range| range.end_row.is_none_or(|end| range.start < end))
            .ok_or_else(|| {
                "give the first row and the one after the last, such as 1000..2000".into()
            })
    }
}

impl fmt::Display for RowRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RowRange {
            start,
            end_row: end,
        } = self;
        match end {
            Some(end) => write!(f, "{start}..{end}"),
            None => write!(f, "{start}.."),
        }
    }
}
