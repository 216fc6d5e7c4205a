//! `ccd check`: checks machine-checkable proofs, by a checker that shares no code with the search and the writer of the proofs.

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
use rows::{Proofs, TableToProve};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use subject::{ExpectedPair, Subject};

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
    /// Folder with NAME.mesh and NAME.body of all meshes [default: the folder of the first proof]
    #[arg(long, value_name = "FOLDER")]
    bodies: Option<PathBuf>,
    /// Body A that the proofs must be about, in the forms of `ccd query --a`
    #[arg(long, value_name = "BODY")]
    a: Option<String>,
    /// Body B that the proofs must be about
    #[arg(long, value_name = "BODY")]
    b: Option<String>,
    #[command(flatten)]
    meshes: MeshArgs,
    /// Distance that the proofs must show between a and b, in the unit of length of the meshes
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = parse_nonnegative, conflicts_with = "urdf")]
    margin: f64,
    /// Table of motions, in the format of `ccd query`; each row must have a proof
    #[arg(long, value_name = "TABLE", requires_all = ["a", "b"], conflicts_with = "urdf")]
    motions: Option<PathBuf>,
    #[command(flatten)]
    cell: CellArgs,
    /// Table of edges or paths, in the format of `ccd edges`; each row must have proofs
    #[arg(long, value_name = "TABLE", requires = "urdf")]
    edges: Option<PathBuf>,
    #[command(flatten)]
    joints: JointsArgs,
    /// Rows of --motions or --edges that must have proofs, numbered from 0, TO excluded; either end may be omitted
    #[arg(
        long,
        value_name = "FROM..TO",
        default_value = "..",
        hide_default_value = true
    )]
    rows: RowRange,
    /// Distance that the proofs must show for all pairs of the cell, such as 0.005 or 5mm
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
A proof holds for the meshes, motions, margins and times that it states; they are printed. With --a and --b it must be about
these bodies. With --robot it must be about all pairs of the robot and its cell; the positions of the joints are printed, and
must keep limits and mimic rules. With --motions or --edges each row of the table must have proofs of its motion, to its end
or until a proven contact; the names of the files do not matter. Without a table, compare the stated motions with yours (--show).

Verdicts:
  holds           the statement is proven
  broken          the proof or a mesh is invalid; the reason follows
  unverifiable    numbers are beyond the range of the checker, or the check would take too long
  other bodies    the proof is about bodies other than --a and --b
  smaller margin  the proof is about a smaller distance than --margin
  other cell      the proof is about bodies, links, pairs or distances other than the ones of --robot, --cell and --clearance
  impossible      a joint is beyond its limits, or not where its mimic rule moves it

Exit codes:
  0  all proofs hold, and each row of the table has proofs
  1  the verdicts cannot be written
  2  bad input, or bad rows of the table
  3  a proof does not hold, a row is not proven to its end or to a contact, or a proof belongs to no row

Examples:
  ccd query --a knot.obj --b knot.obj --motions motions.csv --certificates proofs
  ccd check proofs --a knot.obj --b knot.obj --motions motions.csv
  ccd check proofs/0-hit.proof --a knot.obj --b knot.obj --show
  ccd edges arm.urdf --cell cell.toml --edges moves.csv --certificates edges
  ccd check edges --robot arm.urdf --cell cell.toml
  ccd check edges --robot arm.urdf --cell cell.toml --edges moves.csv";

/// The greatest number of units of length in which the meshes are in memory.
const MAX_UNITS: usize = 16;

/// Runs `ccd check`.
pub(crate) fn run(args: &CheckArgs) -> Result<RunOutcome> {
    let proofs = args.proof_files()?;
    let meshes = Meshes::read(args.folder_of_meshes());
    // A file that is no proof is reported before meshes that are missing.
    let meshes = meshes.or_else(|error| refuse_other_files(&proofs).and(Err(error)))?;
    let cell = args.cell.robot.is_given().then(|| args.cell.load(true));
    let cell = cell.transpose()?;
    let subject = match &cell {
        Some(cell) => Subject::Cell(ProvenCell::new(cell)?, args.clearance),
        None => {
            let expected_pair = ExpectedPair::load([&args.a, &args.b], &args.meshes)?;
            Subject::Pair(Box::new(expected_pair), args.margin)
        }
    };
    // The checker reads the meshes in the unit of length of a proof. Most proofs have the same unit.
    let mut bodies = BTreeMap::new();
    let mut outcome = RunOutcome::AllAnswered;
    let mut held_proofs = Proofs::default();
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
        let (holds, text) = match verdict {
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
        if holds {
            held_proofs.add(&name, statement);
        } else {
            outcome = outcome.max(RunOutcome::SomeRowsUnproven);
        }
    }
    let matched = args
        .table()
        .map(|table| held_proofs.match_rows((table, args.rows), &subject))
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
    /// Returns the files of the proofs, and for a folder all proofs in it.
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
        let folder_of_first = self.proofs.first().and_then(|first| {
            if first.is_dir() {
                Some(first.as_path())
            } else {
                first.parent()
            }
        });
        self.bodies
            .as_deref()
            .or(folder_of_first)
            .unwrap_or(Path::new(""))
    }

    /// Returns the table whose rows have to be proven, if one is given.
    fn table(&self) -> Option<TableToProve<'_>> {
        let motions = self.motions.as_deref().map(TableToProve::Motions);
        let edges = self.edges.as_deref();
        motions.or_else(|| edges.map(|path| TableToProve::Edges(path, &self.joints)))
    }
}
