//! The options of `ccd view`.

use crate::bodies::meshes::MeshArgs;
use crate::bodies::pair::BodiesArgs;
use crate::options::numbers::{parse_nonnegative, tolerance};
use crate::robots::{CellArgs, DEFAULT_PATH_TOLERANCE, JointsArgs, length};
use ccd_core::limits::DEFAULT_TOLERANCE;
use clap::Args;
use std::path::{Path, PathBuf};

/// Write a page that shows queries, a scene of many bodies, or a robot: motions, contacts, the gap over time
#[derive(Clone, Debug, Args)]
#[command(
    mut_arg("joint", |joint| joint.requires("urdf")),
    mut_arg("rest", |rest| rest.requires("urdf")),
    mut_arg("degrees", |degrees| degrees.requires("path")),
    after_help = AFTER_HELP,
    arg_required_else_help = true
)]
pub(crate) struct ViewArgs {
    #[command(flatten)]
    pub(super) cell: CellArgs,
    /// Distance that all pairs of the robot have to keep, such as 0.005 or 5mm
    #[arg(long, value_name = "LENGTH", default_value = "0", value_parser = length, requires = "urdf")]
    pub(super) clearance: f64,
    /// Table of edges or paths of the robot, CSV or Parquet, in the format of `ccd edges`; - reads CSV from standard
    /// input
    #[arg(long, visible_alias = "edges", value_name = "TABLE", requires = "urdf", conflicts_with_all = ["motions", "a", "b", "scene"])]
    pub(super) path: Option<PathBuf>,
    #[command(flatten)]
    pub(super) joints: JointsArgs,
    /// Body A, in the forms of `ccd query --a`
    #[arg(long, value_name = "BODY", requires_all = ["b", "motions"])]
    a: Option<String>,
    /// Body B, in the same forms
    #[arg(long, value_name = "BODY", requires_all = ["a", "motions"])]
    b: Option<String>,
    #[command(flatten)]
    pub(super) meshes: MeshArgs,
    /// Table of motions or paths to show, CSV or Parquet, in the format of `ccd query`; - reads CSV from standard input
    #[arg(
        long,
        value_name = "TABLE",
        required_unless_present_any = ["scene", "urdf"],
        requires = "a"
    )]
    motions: Option<PathBuf>,
    /// Table of results of `ccd query`: show its answers instead of solving the queries
    #[arg(
        long,
        value_name = "CSV",
        requires = "motions",
        conflicts_with_all = ["scene", "urdf"]
    )]
    pub(super) results: Option<PathBuf>,
    /// Show the rows with these ids [default: up to 4 of each status, in the table's order]
    #[arg(
        long,
        value_name = "ID,...",
        value_delimiter = ',',
        conflicts_with = "scene"
    )]
    pub(super) ids: Vec<String>,
    /// Table of the bodies of one scene, CSV or Parquet: column `body` as in --a, columns px, vx, ... as in a table of motions
    #[arg(long, value_name = "TABLE", conflicts_with_all = ["motions", "a", "b", "urdf"])]
    pub(super) scene: Option<PathBuf>,
    /// Time at which the motions of --scene end [default: 1]
    #[arg(long, value_name = "TIME", value_parser = parse_nonnegative, allow_hyphen_values = true, conflicts_with = "urdf")]
    pub(super) duration: Option<f64>,
    /// Report a contact at a distance of at most margin + tolerance [default: 0.001; of a robot 0.0001]
    #[arg(long, value_name = "LENGTH", value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Distance to keep between the bodies
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = parse_nonnegative, allow_hyphen_values = true, conflicts_with = "urdf")]
    pub(super) margin: f64,
    /// Write the page to this file, HTML
    #[arg(long, value_name = "HTML", default_value = "view.html")]
    pub(super) out: PathBuf,
    /// Print only warnings and errors on standard error: no progress, remarks or summary
    #[arg(long, short)]
    pub(super) quiet: bool,
}

impl ViewArgs {
    /// Returns the tolerance. The default is the one of `ccd query`, or of `ccd edges` for a robot.
    pub(super) fn tolerance(&self) -> f64 {
        let default = if self.cell.robot.is_given() {
            DEFAULT_PATH_TOLERANCE
        } else {
            DEFAULT_TOLERANCE
        };
        self.tolerance.unwrap_or(default)
    }

    /// Returns the two bodies and the table of motions; `None` if an option for them is missing.
    pub(super) fn bodies_and_motions(&self) -> Option<(BodiesArgs, &Path)> {
        let bodies = BodiesArgs {
            a: self.a.clone()?,
            b: self.b.clone()?,
            meshes: self.meshes.clone(),
        };
        Some((bodies, self.motions.as_deref()?))
    }
}

const AFTER_HELP: &str = "\
The page is one file that needs no network. It has a view for each row shown: both bodies, a slider for the
time, ghosts of the steps, the measured gap over time with a proven lower bound, and the contact.
For a robot, the gap is the distance of the nearest pair; it is above the proven line at every time.
A motion is shown for its first contact. `ccd query --question ... --html` shows the other questions.

Examples:
  ccd view --a knot.obj --b knot.obj --motions motions.csv --ids 3,17
  ccd view --a knot.obj --b knot.obj --motions motions.csv --results results.csv --out knots.html
  ccd view --scene scene.csv --duration 0.5
  ccd view arm.urdf --cell cell.toml --path moves.csv
  ccd view arm.urdf --joint elbow=-30deg:60deg --joint shoulder=0
  printf 'id,a_px,a_vx\\nhit,-3,4\\n' | ccd view --a box:.5,.5,.5 --b sphere:.3 --motions -
  printf 'body,id,px,vx\\nsphere:.5,ball,-3,4\\n\"box:.5,1,1\",wall,0,0\\n' > balls.csv; ccd view --scene balls.csv

Table of a scene: a row for each body.
  body,id,px,py,pz,vx,vz,wy
  part.obj,lid,0,0,2,0,-1,3
  \"box:1,1,0.1\",table,0,0,0,0,0,0
(A body with commas in it is quoted. Columns that are left out are 0; an empty cell is an error.)";
