//! `ccd check`: checks machine-checkable proofs, by a checker that shares no code with what found and wrote them.

mod meshes;
mod rows;
mod subject;

use crate::bodies::meshes::MeshArgs;
use crate::console::{RunOutcome, print_error};
use crate::files::input_name;
use crate::files::output::print_line;
use crate::options::numbers::parse_nonnegative;
use crate::robots::{CellArgs, JointsArgs, length};
use crate::rows::resumable::RowRange;
use anyhow::{Context, Result, bail};
use ccd_check::check;
use ccd_prove::{ProvenCell, Statement, steps_text};
use clap::Args;
use meshes::{Meshes, files_ending_in};
use rows::{AskedTable, Proofs};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use subject::{Subject, WantedPair};

/// Check machine-checkable proofs of `ccd query` or `ccd edges`
#[derive(Clone, Debug, Args)]
#[command(
    mut_arg("urdf", |urdf| urdf.long("robot").conflicts_with_all(["a", "b"])),
    mut_arg("srdf", |srdf| srdf.requires("urdf")),
    mut_arg("cell", |cell| cell.requires("urdf")),
    mut_arg("joint", |joint| joint.requires("edges")),
    mut_arg("rest", |rest| rest.requires("edges")),
    mut_arg("degrees", |degrees| degrees.requires("edges")),
    after_help = AFTER_HELP
)]
pub(crate) struct CheckArgs {
    /// Proofs, or folders of them; each proof names its meshes by their digests
    #[arg(required = true, value_name = "PROOF|FOLDER")]
    proofs: Vec<PathBuf>,
    /// Folder with NAME.mesh and NAME.body of all meshes [default: that of the first proof]
    #[arg(long, value_name = "FOLDER")]
    bodies: Option<PathBuf>,
    /// Body A that the proofs have to be about, as for `ccd query`
    #[arg(long, value_name = "BODY")]
    a: Option<String>,
    /// Body B that the proofs have to be about
    #[arg(long, value_name = "BODY")]
    b: Option<String>,
    #[command(flatten)]
    meshes: MeshArgs,
    /// Distance that a and b have to keep by the proofs, in the unit of length of the meshes
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = parse_nonnegative, conflicts_with = "urdf")]
    margin: f64,
    /// Table of motions of which each row has to have a proof, as of `ccd query`
    #[arg(long, value_name = "TABLE", requires_all = ["a", "b"], conflicts_with = "urdf")]
    motions: Option<PathBuf>,
    #[command(flatten)]
    cell: CellArgs,
    /// Table of edges or paths of which each row has to have proofs, as of `ccd edges`
    #[arg(long, value_name = "TABLE", requires = "urdf")]
    edges: Option<PathBuf>,
    #[command(flatten)]
    joints: JointsArgs,
    /// Only these rows of --motions or --edges have to have proofs, numbered from 0, TO excluded; either end may be omitted
    #[arg(
        long,
        value_name = "FROM..TO",
        default_value = "..",
        hide_default_value = true
    )]
    rows: RowRange,
    /// Distance that all pairs of the cell have to keep by the proofs, such as 0.005 or 5mm
    #[arg(long, value_name = "LENGTH", default_value = "0", value_parser = length, requires = "urdf")]
    clearance: f64,
    /// Print each statement in full
    #[arg(long)]
    show: bool,
    /// Print the steps of each proof as well
    #[arg(long, requires = "show")]
    steps: bool,
}

const AFTER_HELP: &str = "\
A proof holds for what it states: its meshes, motions, margins and times are printed. With --a and --b it has to be about these
bodies, with --robot about all pairs of the robot and its cell; the positions of its joints are printed, and have to keep limits and
mimic rules. With --motions or --edges each row of the table has to have proofs that state its motion, to the end or until a proven
contact; files may have any names. Else whether the motions are those that you want is yours to compare (--show).

Verdicts:
  holds           what is stated is true
  broken          the proof or a mesh is not what it has to be; the reason follows
  unverifiable    numbers are beyond the range of the checker, or it would take too long
  other bodies    the proof is about bodies other than --a and --b
  smaller margin  it is about a smaller distance than --margin
  other cell      the proof is about bodies, links, pairs or distances other than those of --robot, --cell and --clearance
  impossible      a joint is beyond its limits, or not where its mimic rule moves it

Exit codes:
  0  all proofs hold, and each row of the table has its own
  1  the verdicts cannot be written
  2  bad input, or bad rows of the table
  3  a proof does not hold, a row is not proven to the end or a contact, or a proof is of no row

Examples:
  ccd query --a knot.obj --b knot.obj --motions motions.csv --certificates proofs
  ccd check proofs --a knot.obj --b knot.obj --motions motions.csv
  ccd check proofs/0-hit.proof --a knot.obj --b knot.obj --show
  ccd edges arm.urdf --cell cell.toml --edges moves.csv --certificates edges
  ccd check edges --robot arm.urdf --cell cell.toml
  ccd check edges --robot arm.urdf --cell cell.toml --edges moves.csv";

/// The number of units in which the meshes are kept.
const MAX_UNITS: usize = 16;

/// Runs `ccd check`.
pub(crate) fn run(args: &CheckArgs) -> Result<RunOutcome> {
    let proofs = args.proof_files()?;
    let meshes = Meshes::read(args.folder_of_meshes());
    // Whether a file is a proof matters more than what is beside it.
    let meshes = meshes.or_else(|error| refuse_other_files(&proofs).and(Err(error)))?;
    let cell = args.cell.robot.is_given().then(|| args.cell.load(true));
    let cell = cell.transpose()?;
    let subject = match &cell {
        Some(cell) => Subject::Cell(ProvenCell::new(cell)?, args.clearance),
        None => {
            let wanted = WantedPair::load([&args.a, &args.b], &args.meshes)?;
            Subject::Pair(Box::new(wanted), args.margin)
        }
    };
    // The checker reads the meshes in the unit of each proof, of which there are few.
    let mut bodies = BTreeMap::new();
    let mut outcome = RunOutcome::AllAnswered;
    let mut held = Proofs::default();
    for path in &proofs {
        let name = input_name(path);
        let bytes = ccd_file::read(path).with_context(|| format!("{name}: cannot read it"))?;
        let Some(statement) = Statement::read(&bytes) else {
            print_error(&format!("{name}: this is no proof"));
            outcome = outcome.max(RunOutcome::SomeRowsBad);
            continue;
        };
        if bodies.len() > MAX_UNITS {
            bodies.clear();
        }
        let (bodies, left_out) = bodies
            .entry(statement.units[0])
            .or_insert_with(|| meshes.bodies(&bytes));
        let checked = check(bodies, &bytes).map_err(|stop| match left_out {
            Some(other) => format!("{stop}; a mesh is {other}"),
            None => stop.to_string(),
        });
        let verdict = checked.and_then(|()| subject.verdict(&statement));
        let (is_held, text) = match verdict {
            Ok(text) => (true, text),
            Err(text) => (false, text),
        };
        print_line(&format!("{name}: {text}"))?;
        if args.show {
            statement.to_string().lines().try_for_each(print_line)?;
        }
        if args.steps {
            steps_text(&bytes, &statement)
                .lines()
                .try_for_each(print_line)?;
        }
        if is_held {
            held.add(&name, statement);
        } else {
            outcome = outcome.max(RunOutcome::SomeRowsUnproven);
        }
    }
    let matched = args
        .table()
        .map(|table| held.match_rows((table, args.rows), &subject))
        .transpose()?;
    Ok(matched.map_or(outcome, |matched| outcome.max(matched)))
}

/// Refuses the first file that is no proof.
fn refuse_other_files(proofs: &[PathBuf]) -> Result<()> {
    for path in proofs {
        let name = input_name(path);
        let bytes = ccd_file::read(path).with_context(|| format!("{name}: cannot read it"))?;
        if Statement::read(&bytes).is_none() {
            bail!("{name}: this is no proof");
        }
    }
    Ok(())
}

impl CheckArgs {
    /// Returns the files of the proofs; of a folder all that it has.
    fn proof_files(&self) -> Result<Vec<PathBuf>> {
        let mut files = Vec::new();
        for path in &self.proofs {
            if path.is_dir() {
                let found = files_ending_in("proof", path)?;
                if found.is_empty() && self.table().is_none() {
                    bail!("{}: has no file NAME.proof", path.display());
                }
                files.extend(found);
            } else if path.exists() {
                files.push(path.clone());
            } else {
                bail!("{}: no such file or folder", path.display());
            }
        }
        Ok(files)
    }

    fn folder_of_meshes(&self) -> &Path {
        let of_first = self.proofs.first().and_then(|first| {
            if first.is_dir() {
                Some(first.as_path())
            } else {
                first.parent()
            }
        });
        self.bodies.as_deref().or(of_first).unwrap_or(Path::new(""))
    }

    /// Returns the table whose rows have to be proven, if one is given.
    fn table(&self) -> Option<AskedTable<'_>> {
        let motions = self.motions.as_deref().map(AskedTable::Motions);
        let edges = self.edges.as_deref();
        motions.or_else(|| edges.map(|path| AskedTable::Edges(path, &self.joints)))
    }
}
