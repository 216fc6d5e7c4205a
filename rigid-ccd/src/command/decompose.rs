//! `ccd decompose`: what a mesh becomes.

mod figures;

use super::Exit;
use super::files::check_folder;
use super::files::{CannotWrite, same_file};
use super::pieces::PiecesArgs;
use crate::command::progress::Progress;
use anyhow::{Context, Result, bail};
use ccd_core::Body;
use ccd_decomp::{
    Detail, Model, Order, PrepareError, STORED_EXTENSION, StoreFault, TriangleMesh,
    build_hull_tree, prepare, write_obj_pieces,
};
use clap::{Args, ValueEnum};
use figures::Figures;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Prepare a mesh: count the pieces it becomes, write them, store the body
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP, after_long_help = AFTER_LONG_HELP)]
pub(super) struct DecomposeArgs {
    /// The mesh: .obj, .stl, .ply or .off
    #[arg(value_name = "MESH")]
    mesh: PathBuf,
    #[command(flatten)]
    pieces: PiecesArgs,
    /// In which order --pieces patches grow [default: cresting]
    #[arg(long, value_enum)]
    order: Option<OrderArg>,
    /// Build the tree of convex hulls too, which --schedule fast of a query uses
    #[arg(long)]
    hull_tree: bool,
    /// Where to write the pieces (.obj, one group for each) or the prepared body (.ccd)
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// For whom to print what the mesh has become
    #[arg(long, value_enum, default_value_t)]
    format: FormatArg,
    /// Say nothing on standard error but what is wrong
    #[arg(long, short)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
Examples:
  ccd decompose part.stl
  ccd decompose knot.obj --pieces patches --out patches.obj
  ccd decompose knot.obj --out knot.ccd && ccd query --a knot.ccd --b knot.ccd --motions motions.csv

See `ccd decompose --help` for what is printed and the exit code.";

const AFTER_LONG_HELP: &str = "\
Printed, as aligned lines or with --format json as one object:
  mesh           the file
  pieces_kind    triangles, patches, hull or vhacd; why says what made `auto` choose it
  triangles      how many the mesh has, once it is mended
  pieces         how many convex pieces it becomes
  virtual_faces  facets of the pieces that are no part of the mesh
  tree_nodes     nodes of the binary hierarchy over the pieces
  hulls          hulls kept at these nodes: 0 without --hull-tree
  build_ms       what preparing took, without reading and writing, in milliseconds
  bytes          what the prepared body takes in memory, about
  exact          whether the pieces are the mesh, no more and no less
  sticks_out     how far they reach beyond it at most, in the mesh's unit of length: contacts of such
                 a body may be reported early by as much
  inflated_by    by how much they were grown to be sure to cover the mesh
  rebuilt_hulls  hulls that the hull library got wrong, computed exactly instead
  volume         solid, or surface where being inside is not to be in contact
  remarks        what was amiss with the mesh, if anything

Exit code: 0 when the mesh is prepared and written, 2 on bad input, such as a mesh that bounds no
solid where patches are asked for, 1 when the result cannot be written.

Examples:
  ccd decompose part.stl
  ccd decompose part.stl --pieces vhacd --hulls 64 --format json
  ccd decompose knot.obj --pieces patches --order depth-first --out patches.obj
  ccd decompose knot.obj --hull-tree --out knot.ccd
  ccd query --a knot.ccd --b knot.ccd --motions motions.csv --schedule fast";

/// In which order patches grow.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum OrderArg {
    /// From the crests of the surface outward
    Cresting,
    /// As the mesh has its faces, all around
    BreadthFirst,
    /// As the mesh has its faces, onward
    DepthFirst,
}

/// For whom to print.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum FormatArg {
    /// For people
    #[default]
    Text,
    /// For programs
    Json,
}

/// What a file is to hold.
enum Output<'a> {
    Pieces(&'a Path),
    Body(&'a Path),
}

/// Prepares the mesh, writes it where that is asked for, and prints what has become of it.
pub(super) fn run(args: &DecomposeArgs) -> Result<Exit> {
    // Before the work, not after it, is when to learn that its result has nowhere to go.
    let out = args.out.as_deref().map(Output::of).transpose()?;
    if let Some(out) = &out {
        check_folder(out.path()).map_err(|source| out.failed(source))?;
    }
    if args
        .out
        .as_ref()
        .is_some_and(|out| same_file(&args.mesh, out))
    {
        bail!("--out names the mesh, which it would overwrite; give it another file");
    }
    if args.mesh.extension().is_some_and(|e| e == STORED_EXTENSION) {
        bail!(
            "{}: is prepared already; give the mesh it was made from",
            args.mesh.display()
        );
    }
    let detail = args.detail()?;
    let mesh = TriangleMesh::read(&args.mesh)?;
    let spinner = match args.quiet {
        true => Progress::hidden(),
        false => Progress::of("preparing"),
    };
    let name = args.mesh.display().to_string();
    let start = Instant::now();
    let (model, body) = args.build(&mesh, detail).with_context(|| name.clone())?;
    let build_ms = start.elapsed().as_secs_f64() * 1e3;
    drop(spinner);
    if let Some(out) = out {
        out.write(&model)?;
    }
    let figures = Figures::new(name, &model, &body, build_ms);
    let printed = match args.format {
        FormatArg::Text => writeln!(io::stdout(), "{figures}"),
        FormatArg::Json => print_json(&figures),
    };
    printed.map_err(|source| CannotWrite {
        place: "standard output".to_owned(),
        source,
    })?;
    Ok(Exit::AllAnswered)
}

impl DecomposeArgs {
    fn detail(&self) -> Result<Detail> {
        match (self.pieces.detail()?, self.order) {
            (Detail::Patches(_), Some(order)) => Ok(Detail::Patches(order.into())),
            (_, Some(_)) => bail!("--order says how patches grow; give --pieces patches with it"),
            (detail, None) => Ok(detail),
        }
    }

    fn build(&self, mesh: &TriangleMesh, detail: Detail) -> Result<(Model, Body), PrepareError> {
        let mut model = prepare(mesh, detail)?;
        if !self.hull_tree {
            let body = model.body()?;
            return Ok((model, body));
        }
        // Either takes long, and needs nothing of the other.
        let (body, tree) = rayon::join(|| model.body(), || build_hull_tree(&model.pieces));
        let tree = tree?;
        let body = body?.with_hull_tree(tree.clone())?;
        model.hull_tree = Some(tree);
        Ok((model, body))
    }
}

fn print_json(figures: &Figures) -> io::Result<()> {
    let text = serde_json::to_string(figures)?;
    writeln!(io::stdout(), "{text}")
}

impl<'a> Output<'a> {
    fn of(path: &'a Path) -> Result<Self> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        match extension.to_str() {
            Some("obj") => Ok(Output::Pieces(path)),
            Some(STORED_EXTENSION) => Ok(Output::Body(path)),
            _ => bail!(
                "--out {}: call the file .obj for the pieces, or .{STORED_EXTENSION} for the \
                 prepared body",
                path.display()
            ),
        }
    }

    fn write(&self, model: &Model) -> Result<(), CannotWrite> {
        let written = File::create(self.path()).and_then(|file| match self {
            Output::Pieces(_) => write_obj_pieces(&model.pieces, file),
            Output::Body(_) => model.write(file).map_err(|error| match error.fault {
                StoreFault::Unwritable(error) => error,
                fault => io::Error::other(fault),
            }),
        });
        written.map_err(|source| self.failed(source))
    }

    fn path(&self) -> &'a Path {
        let (Output::Pieces(path) | Output::Body(path)) = *self;
        path
    }

    fn failed(&self, source: io::Error) -> CannotWrite {
        CannotWrite {
            place: self.path().display().to_string(),
            source,
        }
    }
}

impl From<OrderArg> for Order {
    fn from(order: OrderArg) -> Self {
        match order {
            OrderArg::Cresting => Order::Cresting,
            OrderArg::BreadthFirst => Order::BreadthFirst,
            OrderArg::DepthFirst => Order::DepthFirst,
        }
    }
}
