//! `ccd check`: checks machine-checkable proofs, by a checker that shares no code with what found and wrote them.

use crate::files::input_name;
use crate::meshes::MeshArgs;
use crate::output::OutputError;
use crate::printable::PrintableText;
use crate::robots::{CellArgs, length};
use crate::{RunOutcome, print_error};
use anyhow::{Context, Result, bail};
use ccd_check::{Stop, check};
use ccd_decomp::BodySource;
use ccd_prove::{Body, ProvenCell, Statement, steps_text};
use clap::Args;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Check machine-checkable proofs of `ccd query` or `ccd edges`
#[derive(Clone, Debug, Args)]
#[command(
    mut_arg("urdf", |urdf| urdf.long("robot").conflicts_with_all(["a", "b"])),
    mut_arg("srdf", |srdf| srdf.requires("urdf")),
    mut_arg("cell", |cell| cell.requires("urdf")),
    after_help = AFTER_HELP
)]
pub(crate) struct CheckArgs {
    /// Proofs; each names its meshes by their digests
    #[arg(required = true, value_name = "PROOF")]
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
    #[command(flatten)]
    cell: CellArgs,
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
bodies, with --robot about all pairs of the robot and its cell; the positions of its joints are printed. Whether its motions are
those that you want is yours to compare (--show).

Verdicts:
  holds          what is stated is true
  broken         the proof or a mesh is not what it has to be; the reason follows
  unverifiable   numbers are beyond the range of the checker
  other bodies   the proof is about bodies other than --a and --b
  other cell     the proof is about bodies, links, pairs or distances other than those of --robot, --cell and --clearance

Exit code: 0 if all proofs hold, 3 if one does not, 2 for bad input.

Examples:
  ccd query --a knot.obj --b knot.obj --motions motions.csv --certificates proofs
  ccd check proofs/hit.proof --a knot.obj --b knot.obj
  ccd check proofs/*.proof --show
  ccd edges arm.urdf --cell cell.toml --edges moves.csv --certificates edges
  ccd check edges/*.proof --robot arm.urdf --cell cell.toml";

/// The meshes of a folder as bytes, each with the certificate of its tree.
type Meshes = Vec<(Vec<u8>, Vec<u8>)>;

/// Runs `ccd check`.
pub(crate) fn run(args: &CheckArgs) -> Result<RunOutcome> {
    let folder = args.bodies.as_deref();
    let folder = folder.or(args.proofs.first().and_then(|proof| proof.parent()));
    let meshes = read_meshes(folder.unwrap_or(Path::new("")))?;
    let cell = args.cell.robot.is_given().then(|| args.cell.load(true));
    let cell = cell.transpose()?;
    let subject = match &cell {
        Some(cell) => Subject::Cell(ProvenCell::new(cell)?, args.clearance),
        None => Subject::Pair([
            wanted_digest(("--a", &args.a), &args.meshes)?,
            wanted_digest(("--b", &args.b), &args.meshes)?,
        ]),
    };
    // The checker reads the meshes in the unit of each proof, of which there are few.
    let mut bodies = BTreeMap::new();
    let mut outcome = RunOutcome::AllAnswered;
    for path in &args.proofs {
        let name = input_name(path);
        let bytes = fs::read(path).with_context(|| format!("{name}: cannot read it"))?;
        let Some(statement) = Statement::read(&bytes) else {
            print_error(&format!("{name}: this is no proof"));
            outcome = outcome.max(RunOutcome::SomeRowsBad);
            continue;
        };
        let bodies = match bodies.entry(statement.units[0]) {
            Entry::Occupied(bodies) => bodies.into_mut(),
            Entry::Vacant(place) => place.insert(read_bodies(&meshes, &bytes)),
        };
        let verdict = match bodies {
            Ok(bodies) => check(bodies, &bytes),
            Err(stop) => Err(*stop),
        };
        let verdict = match verdict {
            Err(stop) => stop.to_string(),
            Ok(()) => subject.verdict(&statement),
        };
        if !verdict.starts_with("holds") {
            outcome = outcome.max(RunOutcome::SomeRowsUnproven);
        }
        print_line(&format!("{name}: {verdict}"))?;
        if args.show {
            statement.to_string().lines().try_for_each(print_line)?;
        }
        if args.steps {
            steps_text(&bytes, &statement)
                .lines()
                .try_for_each(print_line)?;
        }
    }
    Ok(outcome)
}

/// What proofs have to be about.
enum Subject<'c> {
    /// One pair, whose bodies have these digests, as far as they are given; if none is, anything.
    Pair([Option<[u8; 32]>; 2]),
    /// All pairs of a cell, with a distance that they keep.
    Cell(ProvenCell<'c>, f64),
}

impl Subject<'_> {
    /// Returns the verdict on a proof that holds.
    fn verdict(&self, statement: &Statement) -> String {
        let joints = match self {
            Subject::Pair(wanted) if is_about(statement, wanted) => Vec::new(),
            Subject::Pair(_) => return "other bodies".into(),
            Subject::Cell(cell, clearance) => match cell.joints_of(statement, *clearance) {
                Some(joints) => joints,
                None => return "other cell".into(),
            },
        };
        let joints = joints.iter();
        let joints = joints.map(|(name, [from, to])| format!("{name} {from} to {to}; "));
        format!(
            "holds: {}{}",
            joints.collect::<String>(),
            statement.summary()
        )
    }
}

fn print_line(line: &str) -> Result<()> {
    writeln!(io::stdout(), "{}", PrintableText(line))
        .map_err(OutputError::standard_output_error)?;
    Ok(())
}

/// Reads all files NAME.mesh of a folder, with NAME.body beside them.
fn read_meshes(folder: &Path) -> Result<Meshes> {
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let shown = folder.display();
    let mut meshes = Meshes::new();
    let mut paths = fs::read_dir(folder)
        .with_context(|| shown.to_string())?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<io::Result<Vec<_>>>()
        .with_context(|| shown.to_string())?;
    paths.sort();
    for mesh in paths
        .iter()
        .filter(|path| path.extension().is_some_and(|end| end == "mesh"))
    {
        let read = |path: &Path| fs::read(path).with_context(|| path.display().to_string());
        meshes.push((read(mesh)?, read(&mesh.with_extension("body"))?));
    }
    if meshes.is_empty() {
        bail!("{shown}: has no file NAME.mesh; give --bodies FOLDER");
    }
    Ok(meshes)
}

fn read_bodies(meshes: &Meshes, proof: &[u8]) -> Result<Vec<ccd_check::Body>, Stop> {
    let read = |(mesh, body): &(Vec<u8>, Vec<u8>)| ccd_check::Body::new(mesh, body, proof);
    meshes.iter().map(read).collect()
}

/// Returns the digest of the mesh of a body that is named.
fn wanted_digest(
    (option, body): (&'static str, &Option<String>),
    meshes: &MeshArgs,
) -> Result<Option<[u8; 32]>> {
    let Some(text) = body else {
        return Ok(None);
    };
    let source: BodySource = text.parse().context(option)?;
    let prepared = source
        .load_adjusted(&meshes.adjustments(), meshes.detail())
        .with_context(|| format!("{option} {text}"))?;
    let body =
        Body::of(&prepared.body).with_context(|| format!("{option} {text}: has no triangles"))?;
    Ok(Some(body.digest()))
}

/// Returns whether a statement is about one pair of bodies with these digests.
fn is_about(statement: &Statement, wanted: &[Option<[u8; 32]>; 2]) -> bool {
    if wanted.iter().all(Option::is_none) {
        return true;
    }
    let [([a, b], _)] = statement.pairs[..] else {
        return false;
    };
    let digest = |number: u32| statement.bodies.get(number as usize).map(|body| body.0);
    let is = |wanted: Option<[u8; 32]>, number| wanted.is_none() || wanted == digest(number);
    is(wanted[0], a) && is(wanted[1], b)
}
