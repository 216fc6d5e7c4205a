//! `ccd decompose`: splits a mesh into convex pieces.

mod statistics;

use crate::bodies::meshes::MeshArgs;
use crate::console::RunOutcome;
use crate::console::progress::Progress;
use crate::files::output::{self, Output, OutputError};
use crate::files::refuse_overwriting_input;
use crate::options::named::{PATCH_ORDERS, named_value_parser};
use anyhow::{Context, Result, bail};
use ccd_core::Body;
use ccd_decomp::{
    MeshSource, PatchOrder, PieceChoice, PrepareError, STORED_BODY_EXTENSION, StoreFault,
    StoredBodyContent, TriangleMesh, build_hull_tree, prepare, write_obj_pieces,
};
use clap::{Args, ValueEnum};
use statistics::Statistics;
use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Split a mesh into convex pieces; print statistics, write the pieces or the prepared body
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP, after_long_help = AFTER_LONG_HELP)]
pub(crate) struct DecomposeArgs {
    /// Mesh file (.gltf, .glb, .dae, .obj, .stl, .ply or .off), or a part of one by its name or number: scene.glb#lid;
    /// either with adjustments: part.stl@mm, @scale=0.001, @mirror=x, @surface
    #[arg(value_name = "MESH")]
    mesh: OsString,
    #[command(flatten)]
    meshes: MeshArgs,
    /// Order in which --pieces patches grow [default: cresting]
    #[arg(long, value_parser = named_value_parser(PATCH_ORDERS))]
    order: Option<PatchOrder>,
    /// Also build the tree of convex hulls, for `ccd query --schedule fast`
    #[arg(long)]
    hull_tree: bool,
    /// Write the pieces (.obj, one group for each) or the prepared body (.ccd) to this file
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Output format of the statistics
    #[arg(long, value_enum, default_value_t)]
    format: StatisticsFormatArg,
    /// Print only warnings and errors on standard error
    #[arg(long, short)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
Examples:
  ccd decompose part.stl
  ccd decompose 'scene.glb#lid' --unit mm --out lid.ccd
  ccd decompose knot.obj --pieces patches --out patches.obj
  ccd decompose knot.obj --out knot.ccd && ccd query --a knot.ccd --b knot.ccd --motions motions.csv

See `ccd decompose --help` for the statistics and the exit codes.";

const AFTER_LONG_HELP: &str = "\
Statistics, as aligned lines or, with --format json, as one object:
  mesh           the file
  unit           unit of the coordinates, if the file states one or --unit gives it
  pieces_kind    triangles, patches, hull or outer-hull
  why            reason for this kind of pieces
  triangles      number of triangles of the mesh, after repairs
  pieces         number of convex pieces
  virtual_faces  number of facets of the pieces that are not part of the mesh
  tree_nodes     number of nodes of the bounding volume hierarchy over the pieces
  hulls          number of hulls stored at these nodes; 0 without --hull-tree
  build_ms       preparation time in milliseconds, without reading and writing
  bytes          approximate size of the prepared body in memory
  exact          whether the pieces represent the mesh exactly
  excess         upper bound on how far the pieces extend beyond the mesh, in the mesh's unit of
                 length; contacts may be reported early by as much
  volume         solid, or surface: a body inside a surface is not in contact with it
  remarks        defects of the mesh and their repairs, if any

Exit codes:
  0  the mesh is prepared and written
  1  the result cannot be written
  2  bad input, such as a mesh that does not bound a solid with --pieces patches

Examples:
  ccd decompose part.stl
  ccd decompose part.stl --pieces outer-hull --format json
  ccd decompose knot.obj --pieces patches --order depth-first --out patches.obj
  ccd decompose knot.obj --hull-tree --out knot.ccd
  ccd query --a knot.ccd --b knot.ccd --motions motions.csv --schedule fast";

/// The output format of the statistics.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum StatisticsFormatArg {
    /// Aligned lines
    #[default]
    Text,
    /// One JSON object
    Json,
}

/// The kind of file that `--out` writes: pieces or a prepared body.
#[derive(Clone, Copy, Debug, PartialEq)]
enum OutputKind {
    Pieces,
    Body,
}

/// Runs `ccd decompose`: prepares the mesh, writes the output file if any, and prints the statistics.
pub(crate) fn run(args: &DecomposeArgs) -> Result<RunOutcome> {
    let mut source = MeshSource::try_from(args.mesh.clone())?;
    source.adjustments = source
        .adjustments
        .combined_with(&args.meshes.adjustments())?;
    refuse_prepared_input(&source.file)?;
    let choice = source.choice(args.choice()?);
    let out = args.out.as_deref().map(|out| claim(out, &source.file));
    let out = out.transpose()?;
    let (mesh, unit) = source.read()?;
    let spinner = Progress::start_single_step("preparing", args.quiet);
    let name = source.to_string();
    let start = Instant::now();
    let (model, body) = args.build(&mesh, choice).with_context(|| name.clone())?;
    let build_ms = start.elapsed().as_secs_f64() * 1e3;
    drop(spinner);
    if let Some((output_kind, out)) = out {
        output_kind.write(&model, out)?;
    }
    let statistics = Statistics::new((name, unit), &model, &body, build_ms);
    match args.format {
        StatisticsFormatArg::Text => output::print(&statistics)?,
        StatisticsFormatArg::Json => output::print(serde_json::to_string(&statistics)?)?,
    }
    Ok(RunOutcome::AllAnswered)
}

/// Reserves the output file before the decomposition. So a file that cannot be written is reported at once, not after
/// the long work.
fn claim(out: &Path, mesh: &Path) -> Result<(OutputKind, Output)> {
    let output_kind = OutputKind::from_extension_of(out)?;
    refuse_overwriting_input(("the mesh", mesh), ("--out", out))?;
    Ok((output_kind, Output::claim(out)?))
}

fn refuse_prepared_input(mesh: &Path) -> Result<()> {
    if mesh.extension().is_some_and(|e| e == STORED_BODY_EXTENSION) {
        bail!(
            "{}: is already a prepared body; give the mesh it was made from",
            mesh.display()
        );
    }
    Ok(())
}

impl DecomposeArgs {
    fn choice(&self) -> Result<PieceChoice> {
        match (self.meshes.choice(), self.order) {
            (PieceChoice::Patches(_), Some(order)) => Ok(PieceChoice::Patches(order)),
            (_, Some(_)) => bail!("--order needs --pieces patches"),
            (choice, None) => Ok(choice),
        }
    }

    fn build(
        &self,
        mesh: &TriangleMesh,
        choice: PieceChoice,
    ) -> Result<(StoredBodyContent, Body), PrepareError> {
        let mut model = prepare(mesh, choice)?;
        if !self.hull_tree {
            let body = model.body()?;
            return Ok((model, body));
        }
        // Both take long and are independent of each other.
        let (body, tree) = rayon::join(|| model.body(), || build_hull_tree(&model.pieces));
        let tree = tree?;
        let body = body?.with_hull_tree(tree.clone())?;
        model.hull_tree = Some(tree);
        Ok((model, body))
    }
}

impl OutputKind {
    fn from_extension_of(path: &Path) -> Result<Self> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        match extension.to_str() {
            Some("obj") => Ok(OutputKind::Pieces),
            Some(STORED_BODY_EXTENSION) => Ok(OutputKind::Body),
            _ => bail!(
                "--out {}: use the extension .obj for the pieces, or .{STORED_BODY_EXTENSION} for the \
                 prepared body",
                path.display()
            ),
        }
    }

    fn write(self, model: &StoredBodyContent, out: Output) -> Result<(), OutputError> {
        out.write(|writer| match self {
            OutputKind::Pieces => write_obj_pieces(&model.pieces, writer),
            OutputKind::Body => model.write(writer).map_err(|error| match error.fault {
                StoreFault::Unwritable(error) => error,
                fault => io::Error::other(fault),
            }),
        })
    }
}
