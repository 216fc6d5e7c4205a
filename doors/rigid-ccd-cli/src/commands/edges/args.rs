//! The options of `ccd edges`.

use crate::options::named::{named_value_parser, start_policy_parser};
use crate::options::numbers::parse_seconds;
use crate::robots::DEFAULT_PATH_TOLERANCE;
use crate::robots::joint_values::{JointsArgs, length, tolerance_length};
use crate::robots::loading::CellArgs;
use crate::rows::resumable::RowRange;
use ccd_core::StartPolicy;
use clap::Args;
use rigid_ccd::Question;
use std::path::PathBuf;
use std::time::Duration;

/// Certify edges or paths of a robot: free, first contact, or least distance
#[derive(Clone, Debug, Args)]
#[command(mut_arg("urdf", |urdf| urdf.required(true)), after_help = AFTER_HELP, after_long_help = AFTER_LONG_HELP)]
pub(crate) struct EdgesArgs {
    #[command(flatten)]
    pub(super) cell: CellArgs,
    /// Distance that all pairs have to keep, such as 0.005 or 5mm
    #[arg(long, value_name = "LENGTH", default_value = "0", value_parser = length, allow_hyphen_values = true)]
    pub(super) clearance: f64,
    /// Table of edges or paths, CSV or Parquet; - reads CSV from standard input
    #[arg(long, value_name = "TABLE")]
    pub(super) edges: PathBuf,
    #[command(flatten)]
    pub(super) joints: JointsArgs,
    /// Question that every row answers
    #[arg(long, value_parser = named_value_parser(QUESTIONS.map(|(question, help)| (question.name(), question, help))), default_value = "is-free")]
    pub(super) question: Question,
    /// Report a contact at a distance of at most clearance + tolerance, in metres
    #[arg(long, value_name = "LENGTH", default_value_t = DEFAULT_PATH_TOLERANCE, value_parser = tolerance_length, allow_hyphen_values = true)]
    pub(super) tolerance: f64,
    /// How to treat pairs in contact at the start of a row, such as an object that is lifted; not for closest-approach
    #[arg(long, value_parser = start_policy_parser(), default_value = "report")]
    pub(super) start: StartPolicy,
    /// Leave a row unresolved after this time, in seconds [default: none]
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds, allow_hyphen_values = true)]
    pub(super) deadline: Option<Duration>,
    /// Number of threads; it changes no answer [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    /// Answer only these edges or paths, numbered from 0, TO excluded; either end may be omitted
    #[arg(
        long,
        value_name = "FROM..TO",
        default_value = "..",
        hide_default_value = true
    )]
    pub(super) rows: RowRange,
    /// Write the table of results to this file, CSV; - writes to standard output
    #[arg(long, value_name = "CSV", default_value = "-")]
    pub(super) out: PathBuf,
    /// Write machine-checkable proofs to this folder: ROW-ID.proof for each edge, ROW.SEGMENT-ID.proof for each segment
    /// of a path that begins in a row, until the first contact; `ccd check` checks them
    #[arg(long, value_name = "FOLDER")]
    pub(super) certificates: Option<PathBuf>,
    /// Leave column `micros` empty, so that equal answers give equal files
    #[arg(long)]
    pub(super) no_micros: bool,
    /// Continue an interrupted run of the same command after its last complete row; a finished run is left unchanged
    #[arg(long)]
    pub(super) resume: bool,
    /// End with exit code 3 unless every row is `free` or, with --question closest-approach, `kept`
    #[arg(long)]
    pub(super) check: bool,
    /// Print only warnings and errors on standard error
    #[arg(long, short)]
    pub(super) quiet: bool,
}

/// The questions of `--question`, each with its help.
const QUESTIONS: [(Question, &str); 3] = [
    (Question::AnyContact, "Does nothing touch?"),
    (Question::FirstContact, "What touches first, and where?"),
    (Question::ClosestApproach, "How near does any pair come?"),
];

/// The ids of the options that the journal does not record, because they change no byte of the table, or are recorded
/// in another form.
pub(super) const UNRECORDED_OPTIONS: [&str; 7] = [
    "edges", "threads", "out", "resume", "check", "quiet", "rows",
];

const AFTER_HELP: &str = "\
Examples:
  ccd edges arm.urdf --cell cell.toml --edges moves.csv --out results.csv
  ccd edges arm.urdf --srdf arm.srdf --cell cell.toml --edges moves.csv --clearance 5mm --question first-contact
  ccd edges arm.urdf --cell cell.toml --edges path.csv --question closest-approach
  printf 'from_shoulder,to_shoulder\\n0,1.5\\n' | ccd edges arm.urdf --joint elbow=30deg --edges -

An SRDF of `ccd acm` leaves out pairs that never touch, even if they come nearer than --clearance.

See `ccd edges --help` for the columns, the file of a cell and the exit codes.";

const AFTER_LONG_HELP: &str = "\
Table of edges: a row for each edge, on which all joints move at constant rates.
  id                        name of the row in the results [default: its number]
  from_JOINT, to_JOINT      position of the joint at the start and at the end: radians or metres
Table of paths: a row for each configuration; rows of one id follow each other.
  id                        name of the path [default: all rows are one path]
  t                         time of the row, later than in the row before [default: 0, 1, 2, ...]
  JOINT                     position of the joint, which is not named id or t
Each independent joint needs its columns, or --joint. Mimic joints have no columns.
In Parquet, columns hold numbers, text or booleans, and an absent value is an empty cell.

Cell (--cell), TOML. Bodies have the forms of `ccd query --a`; files are searched next to the cell.
  [[obstacle]]
  name = \"table\"
  body = \"box:0.8,0.8,0.02\"       # half extents
  position = [0, 0, -0.05]        # in the frame of the robot's base [default: 0]
  rpy = [0, 0, 1.57]              # or quaternion_xyzw [default: none]
  moves = \"floating\"              # or planar: it gets joints, table/base/x and so on [default: it rests]
  [[plane]]                       # a half-space without an end, below z = 0 of its frame
  name = \"floor\"
  position = [0, 0, -0.1]         # and rpy or quaternion_xyzw, like an obstacle
  [[robot]]                       # another robot, placed like an obstacle; its joints are right/shoulder and so on
  name = \"right\"
  urdf = \"arm.urdf\"               # and srdf
  base = \"planar\"                 # or floating [default: it rests]
  [[attached]]                    # an object that a link holds: like an obstacle, in the link's frame, with
  link = \"hand\"
  may_touch = [\"finger\"]          # links, other objects and obstacles
  [padding]                       # distance that obstacles keep from a link, added to --clearance
  hand = 0.01
  [[clearance]]                   # distance that a pair keeps, instead of --clearance and padding
  between = [\"hand\", \"table\"]
  distance = 0.002
  [[allowed]]                     # a pair that may touch, and has no clearance
  between = [\"finger\", \"table\"]
A glTF is a cell, too: each of its parts is an obstacle.

Table of results:
  id
  status    free            proven: all pairs that are checked stay farther apart than the clearance, between the
                            configurations too
            contact         a pair comes within clearance + tolerance
            overlapping     a pair overlaps at the start (first-contact)
            measured        the least distance is between distance_lower and distance_upper
            kept, violated, unverified
                            the least distance, compared with --clearance alone, not with paddings and [[clearance]]
            unresolved      a limit was reached; of first-contact: free until `time`
            error           the row is no valid question; see `reason`
  time                      time of the pair: on an edge from 0 to 1; on a path the number of the segment plus the fraction
                            of it, or the time of column `t`. Nothing touches before a first contact: this is proven
  a, b                      links, held objects or obstacles; a belongs to the robot
  distance_lower, distance_upper
                            bounds of the distance of a and b at `time`; of closest-approach: of the least distance of
                            all pairs on the path. distance_upper includes by how much bodies exceed their shapes
  witness_a_x ... witness_b_z
                            nearest points of both at `time`, in the frame of the base
  feature_a, feature_b      the vertex, edge or face of the mesh that each point is on (v7, e3-4, f5); empty for a convex
                            body or a hull, and if one body is inside the other
  micros, reason            time of this row in microseconds; why it is unresolved or an error
is-free has the columns id, status, micros and reason.

Exit codes:
  0  every row has an answer, whatever it is
  1  the results cannot be written
  2  bad input, rows of status `error`, or with --check no row
  3  with --check: a row is not `free` or `kept`

Examples:
  ccd edges arm.urdf --cell cell.toml --edges moves.csv --out results.csv
  ccd edges arm.urdf --srdf arm.srdf --cell cell.toml --edges moves.csv --clearance 5mm --question first-contact
  ccd edges arm.urdf --cell cell.toml --edges path.csv --question closest-approach
  printf 'from_shoulder,to_shoulder\\n0,1.5\\n' | ccd edges arm.urdf --joint elbow=30deg --edges -";
