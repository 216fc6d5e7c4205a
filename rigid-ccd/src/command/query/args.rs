//! What `ccd query` can be told.

use crate::batch::{BoundKind, OracleKind, ScheduleKind};
use crate::command::pieces::{NOT_GIVEN, PiecesArgs, word};
use crate::table::results::Extent;
use crate::text::Number;
use ccd_core::StartPolicy;
use ccd_core::limits::{DEFAULT_BUDGET, DEFAULT_TOLERANCE, MAX_COORDINATE};
use clap::{Args, ValueEnum};
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

/// Answer a table of motions of two bodies
#[derive(Clone, Debug, Args)]
#[command(after_help = QUERY_AFTER_HELP, after_long_help = QUERY_AFTER_LONG_HELP)]
pub(in crate::command) struct QueryArgs {
    /// Body A: a mesh (.obj .stl .ply .off), a prepared body (.ccd, see `ccd decompose`),
    /// box:HX,HY,HZ (half extents), sphere:R or capsule:R,HALF_HEIGHT
    #[arg(long, value_name = "BODY")]
    pub(super) a: String,
    /// Body B, as body A; the same file is loaded once
    #[arg(long, value_name = "BODY")]
    pub(super) b: String,
    /// The table of motions, CSV; - reads standard input
    #[arg(long, value_name = "CSV")]
    pub(super) motions: PathBuf,
    /// Who measures the distance of two pieces
    #[arg(long, value_enum, default_value_t)]
    pub(super) oracle: OracleKind,
    /// In which order pairs of pieces are looked at
    #[arg(long, value_enum, default_value_t)]
    pub(super) schedule: ScheduleKind,
    /// How far the bodies may advance in a step of --schedule fast or naive [default: sound]
    #[arg(long, value_enum)]
    pub(super) bound: Option<BoundKind>,
    #[command(flatten)]
    pub(super) pieces: PiecesArgs,
    /// Report a contact at a distance of at most margin + tolerance, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value_t = DEFAULT_TOLERANCE, value_parser = positive, allow_hyphen_values = true)]
    pub(super) tolerance: f64,
    /// The distance to keep; 0 reports touching
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = not_negative, allow_hyphen_values = true)]
    pub(super) margin: f64,
    /// What becomes of bodies in contact at the start
    #[arg(long, value_enum, default_value_t)]
    pub(super) start: StartArg,
    /// How much work may be done before a query is left unresolved: pairs of nodes visited, and what
    /// costs as much; a million takes about a second
    #[arg(long, value_name = "N", default_value_t = DEFAULT_BUDGET,
          value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) budget: u64,
    /// How long a query may take, in seconds, before it is left unresolved
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub(super) deadline: Option<Duration>,
    /// Threads to answer on; any number gives the same answers, one the truest times [default: all
    /// there are]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    /// Answer these rows alone: FROM..TO, numbered from 0, TO not included; either may be left out
    #[arg(
        long,
        value_name = "FROM..TO",
        default_value = "..",
        hide_default_value = true
    )]
    pub(super) rows: RowRange,
    /// Answer each query so many times and report the median time
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(super) repeat: u32,
    /// The table of results, CSV; - writes to standard output
    #[arg(long, value_name = "CSV", default_value = "-")]
    pub(super) out: PathBuf,
    /// A table of all pairs of features in contact, CSV; - writes to standard output, when --out does
    /// not
    #[arg(long, value_name = "CSV")]
    pub(super) contacts: Option<PathBuf>,
    /// More columns for the table of results, and their means: what the query took besides visits
    #[arg(long)]
    pub(super) counters: bool,
    /// Leave the cells of `micros` empty, so that equal answers are equal files
    #[arg(long)]
    pub(super) no_micros: bool,
    /// Go on behind the last row that an interrupted run with the same options has written to --out;
    /// what a finished one has written is left as it is
    #[arg(long)]
    pub(super) resume: bool,
    /// Say nothing on standard error but what is wrong
    #[arg(long, short)]
    pub(super) quiet: bool,
}

impl QueryArgs {
    /// Which columns the table of results gets.
    pub(super) fn extent(&self) -> Extent {
        match self.counters {
            true => Extent::WithCounters,
            false => Extent::Results,
        }
    }

    /// The options that tables depend on, with their values.
    pub(super) fn asked(&self) -> Vec<(&'static str, String)> {
        // Whoever adds an option is asked here whether tables depend on it.
        let QueryArgs {
            a,
            b,
            motions: _,
            oracle,
            schedule,
            bound,
            pieces,
            tolerance,
            margin,
            start,
            budget,
            deadline,
            threads: _,
            rows,
            repeat,
            out: _,
            contacts,
            counters,
            no_micros,
            resume: _,
            quiet: _,
        } = self;
        let flag = |given| if given { "given" } else { NOT_GIVEN }.to_owned();
        let bound = bound.map(|bound| bound.to_string());
        let deadline = deadline.map(|time| Number(time.as_secs_f64()).to_string());
        let contacts = contacts.as_ref().map(|path| path.display().to_string());
        let or_not = |value: Option<String>| value.unwrap_or_else(|| NOT_GIVEN.to_owned());
        let mut asked = vec![
            ("--a", a.clone()),
            ("--b", b.clone()),
            ("--oracle", oracle.to_string()),
            ("--schedule", schedule.to_string()),
            ("--bound", or_not(bound)),
            ("--tolerance", Number(*tolerance).to_string()),
            ("--margin", Number(*margin).to_string()),
            ("--start", word(start)),
            ("--budget", budget.to_string()),
            ("--deadline", or_not(deadline)),
            ("--rows", rows.to_string()),
            ("--repeat", repeat.to_string()),
            ("--contacts", or_not(contacts)),
            ("--counters", flag(*counters)),
            ("--no-micros", flag(*no_micros)),
        ];
        asked.extend(pieces.asked());
        asked
    }
}

const QUERY_AFTER_HELP: &str = "\
Examples:
  ccd query --a knot.obj --b knot.obj --motions motions.csv --out results.csv
  printf 'a_pz,a_vz\\n3,-4\\n' | ccd query --a box:.5,.5,.5 --b box:9,9,1 --motions -

See `ccd query --help` for the columns of both tables and the exit code.";

const QUERY_AFTER_LONG_HELP: &str = "\
Table of motions: columns by name, in any order; all may be left out, and so may single cells.
Rows count from 0 everywhere: in ids, in --rows and in messages. Lines of a file count from 1.
  id                        what the row is called; default: its number, from 0
  a_px a_py a_pz            A's position at the start; default 0
  a_qw a_qx a_qy a_qz       A's orientation at the start, normalised; default identity
  then either the end pose, reached by the shortest turn
  a_end_px a_end_py a_end_pz a_end_qw a_end_qx a_end_qy a_end_qz
                            position or orientation left out: as at the start. Half a turn can go either
                            way: it goes counterclockwise about (x, y, z) of end · start⁻¹, so that the
                            signs of the quaternions decide (within 1e-15 of it, rounding does). Give
                            velocities to be sure
  or velocities in the world's frame, per unit of time, any number of turns
  a_vx a_vy a_vz a_wx a_wy a_wz            default 0
  a_cx a_cy a_cz            the point of A that moves straight, in A's frame; default its origin
  b_px …                    the same for B
  duration                  default 1
  Coordinates of meshes, positions and centres: -1e12 to 1e12. Up to 1e12 also the distance from B's
  position at the start to either centre and on along its travel, --tolerance and --margin; turns up to
  1e6 radians. A row beyond that is refused.

Table of results:
  status    contact      within margin + tolerance at `time`, certainly not touching before
            free         apart for the whole duration, by distance_lower at all times
            touching     within margin + tolerance at the start
            overlapping  intersecting at the start, or one solid inside the other
            unresolved   a limit was reached (--budget, --deadline, or what can be certified): certainly
                         no contact before `time`, nothing known after
            error        the row asks nothing that can be answered; most cells are empty
  time      certified: no contact before it; 0 to duration
  normal, witnesses         in the world's frame at `time`; the normal points from A to B
  feature_a, feature_b      v7, e3-7, f12: vertex, edge, face as numbered in the mesh, from 0
  iterations, oracle_calls  what the query took
  micros                    its time alone, in microseconds, on the thread that answered it; with all
                            cores at work each may take longer: measure with --threads 1
  reason                    of error what is wrong; of unresolved which limit: budget, deadline,
                            stalled, oracle gave up, undecided
  with --counters also
  advancements              how often all pairs were advanced together; 0 where each has its clock
  oracle_steps, cycles      the oracle's: from feature to feature; back to where it had been
  fallbacks                 how often it gave up and another one was asked
  front                     the most pairs that waited at one time

Table of contacts (--contacts): at the time of each row that ends in contact or touching, all pairs
of features within margin + tolerance, nearest first. A pair is a vertex and a face that it has its
foot in, or two edges that cross; or, where there is no such thing, vertex and edge, or vertices.
  id, time                  as in the results
  feature_a, feature_b, distance_lower, distance_upper, normal_x … witness_b_z
                            as in the results, of the two features

Rows are written in order as they are answered, results and contacts to files that end in .partial,
which get their names once all rows are there; until then what had the names is left alone. When a run
is interrupted, the same command with --resume goes on behind its last row, and where all rows are
there, it leaves the tables as they are and exits as the run did that wrote them. For this a file that
ends in .resume stays beside --out: it says what was asked. Bytes are the same for any
number of threads and interruptions, but for micros (--no-micros leaves it out) and --deadline.
--rows 0..1000 and --rows 1000..2000 are parts of one table, for two machines; ids are numbered
through.

With --bound published no time is certified: contacts may be late, or missed.

Exit code: 0 when every row is answered (unresolved is an answer, and no rows are none to answer), 2
when there are rows of status error, or on other bad input; 2 also when a row has more contacts than
--budget allows; 1 when the results or the contacts cannot be written.

Examples:
  ccd query --a knot.obj --b knot.obj --motions motions.csv --out results.csv
  ccd query --a part.stl --b box:1,1,.1 --motions - --tolerance 1e-6 < motions.csv
  ccd query --a part.stl --b part.stl --motions motions.csv --out results.csv --contacts contacts.csv
  ccd query --a part.stl --b part.stl --motions motions.csv --out results.csv \\
      --schedule fast --oracle vmarch --pieces patches --counters    # the paper's own way
  printf 'a_pz,a_vz\\n3,-4\\n' | ccd query --a box:.5,.5,.5 --b box:9,9,1 --motions -";

/// What becomes of a contact at the start.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(super) enum StartArg {
    /// It is the answer
    #[default]
    Report,
    /// Bodies in contact are let go as long as they do not approach
    Leave,
}

/// Some rows of a table that lie together, numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct RowRange {
    /// The first one.
    pub(super) start: usize,
    /// The first one that is not among them any more.
    pub(super) end: Option<usize>,
}

impl RowRange {
    pub(super) fn is_all(self) -> bool {
        self.start == 0 && self.end.is_none()
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
            Some(RowRange { start, end })
        });
        range
            .filter(|range| range.end.is_none_or(|end| range.start < end))
            .ok_or_else(|| {
                "give the first row and the one behind the last, such as 1000..2000".into()
            })
    }
}

impl fmt::Display for RowRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RowRange { start, end } = self;
        match end {
            Some(end) => write!(f, "{start}..{end}"),
            None => write!(f, "{start}.."),
        }
    }
}

fn positive(text: &str) -> Result<f64, String> {
    number(text)
        .filter(|value| *value > 0.0 && *value <= MAX_COORDINATE)
        .ok_or_else(|| format!("give a positive number up to {MAX_COORDINATE:e}, such as 1e-3"))
}

fn not_negative(text: &str) -> Result<f64, String> {
    number(text)
        .filter(|value| (0.0..=MAX_COORDINATE).contains(value))
        .ok_or_else(|| format!("give a number from 0 to {MAX_COORDINATE:e}, such as 0.01"))
}

fn seconds(text: &str) -> Result<Duration, String> {
    number(text)
        .and_then(|value| Duration::try_from_secs_f64(value).ok())
        .ok_or_else(|| "give a number of seconds of at least 0, such as 0.01".to_owned())
}

fn number(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|value| value.is_finite())
}

impl From<StartArg> for StartPolicy {
    fn from(start: StartArg) -> Self {
        match start {
            StartArg::Report => StartPolicy::Report,
            StartArg::Leave => StartPolicy::Leave,
        }
    }
}
