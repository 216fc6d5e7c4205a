//! The options that name the two bodies of a query, and the loading of these bodies.

use crate::bodies::meshes::MeshArgs;
use crate::bodies::size::{sides_text, warn_of_different_units};
use crate::console::progress::Progress;
use crate::console::{print_error, print_escaped_to_stderr, print_remarks};
use crate::files::{Rows, is_same_file};
use crate::options::solver_kind::SolverKind;
use anyhow::{Context, Error, Result};
use ccd_core::Body;
use ccd_decomp::{BodySource, PreparedBody, Unit, build_hull_tree};
use ccd_tables::batch::BodyPair;
use clap::Args;
use rigid_ccd::Remark;
use std::path::PathBuf;

/// The options that name both bodies.
#[derive(Clone, Debug, Args)]
pub(crate) struct BodiesArgs {
    /// Body A: a mesh file (.gltf, .glb, .dae, .obj, .stl, .ply, .off), a part of one by its name or number
    /// (scene.glb#lid), either with adjustments (part.stl@mm, @scale=0.001, @mirror=x, @surface), a prepared body
    /// (.ccd, see `ccd decompose`), box:HX,HY,HZ (half extents), sphere:R, capsule:R,HALF_HEIGHT,
    /// cylinder:R,HALF_HEIGHT or cone:R,HALF_HEIGHT
    #[arg(long, value_name = "BODY")]
    pub(crate) a: String,
    /// Body B, in the same forms as body A; a file given for both is loaded once
    #[arg(long, value_name = "BODY")]
    pub(crate) b: String,
    #[command(flatten)]
    pub(crate) meshes: MeshArgs,
}

impl BodiesArgs {
    /// Returns the files of both bodies, each with the option that names it.
    ///
    /// # Errors
    /// If an option names no body.
    pub(crate) fn files_with_options(&self) -> Result<Vec<(&'static str, PathBuf)>> {
        let files = |(option, source): (_, BodySource)| {
            files_of_source(&source)
                .into_iter()
                .map(move |path| (option, path))
        };
        Ok(self.sources()?.into_iter().flat_map(files).collect())
    }

    /// Returns where both bodies come from, each with the option that names it.
    fn sources(&self) -> Result<[(&'static str, BodySource); 2]> {
        let source = |option, text: &str| Ok::<_, Error>((option, text.parse().context(option)?));
        Ok([source("--a", &self.a)?, source("--b", &self.b)?])
    }

    /// Loads both bodies, and prepares them for a solver of the given kind. If `quiet`, messages about them are
    /// suppressed.
    pub(crate) fn load(&self, solver_kind: SolverKind, quiet: bool) -> Result<Pair> {
        let sources = self.sources()?;
        let [(_, source_a), (_, source_b)] = &sources;
        let load =
            |option, text, source| self.load_body((option, text), source, solver_kind, quiet);
        let (a, unit_a) = load("--a", &self.a, source_a)?;
        let b = if is_same_source(source_a, source_b) {
            None
        } else {
            Some(load("--b", &self.b, source_b)?)
        };
        if let (Some((b, unit_b)), false) = (&b, quiet) {
            let sources = [(source_a, unit_a), (source_b, *unit_b)];
            match mixed_units_warning(sources) {
                Some(remark) => print_error(&remark),
                None => warn_of_different_units(&a, b),
            }
        }
        let b = b.map(|(b, _)| b);
        let checksums = (sources.each_ref())
            .map(|(option, source)| (*option, format!("{:08x}", checksum(source))));
        Ok(Pair { a, b, checksums })
    }

    /// Loads one body, and returns it with the unit of length that its file states.
    fn load_body(
        &self,
        (option, text): (&str, &str),
        source: &BodySource,
        solver_kind: SolverKind,
        quiet: bool,
    ) -> Result<(Body, Option<Unit>)> {
        let choice = self.meshes.choice();
        let progress = Progress::start_single_step(&format!("preparing {text}"), quiet);
        let loaded = source.load_adjusted(&self.meshes.adjustments(), choice);
        let PreparedBody {
            mut body,
            report,
            unit,
        } = loaded.with_context(|| option.to_owned())?;
        if solver_kind.schedule.uses_hull_trees() && body.hull_tree().is_none() {
            body = attach_hull_tree(body).with_context(|| format!("{option} {text}"))?;
        }
        solver_kind.prepare_body(&body);
        drop(progress);
        let remarks = &report.repairs.remarks;
        if !quiet {
            let unit = unit.map(|unit| format!(" {unit}")).unwrap_or_default();
            let size = sides_text(&body);
            print_escaped_to_stderr(&format!("{option} {text}: {report}, size {size}{unit}"));
        } else if !remarks.is_empty() {
            print_error(&format!("{option} {text}: {remarks}"));
        }
        Ok((body, unit))
    }
}

/// Both bodies of a query; `b` is `None` when both come from the same file or primitive.
pub(crate) struct Pair {
    a: Body,
    b: Option<Body>,
    /// The checksums of the bodies' files, each with the option that names the file.
    pub(crate) checksums: [(&'static str, String); 2],
}

impl Pair {
    /// Prints the remarks about the rows of a table, and a remark if the tolerance is large relative to the smaller
    /// body.
    pub(crate) fn print_remarks(&self, tolerance: f64, rows: &Rows) {
        let BodyPair { a, b } = self.bodies();
        let remark = Remark::remark_on_tolerance(tolerance, [a, b].map(Remark::body_size));
        print_remarks(remark.into_iter().chain(rows.remarks()));
    }

    pub(crate) fn bodies(&self) -> BodyPair<'_> {
        BodyPair {
            a: &self.a,
            b: self.b.as_ref().unwrap_or(&self.a),
        }
    }
}

/// Returns a warning if two files have different units, or if the unit of only one file is known; `None` otherwise.
/// Primitives such as boxes have no unit.
fn mixed_units_warning(
    [(source_a, a), (source_b, b)]: [(&BodySource, Option<Unit>); 2],
) -> Option<String> {
    let (file_with_unit, unit, other_file) = match (a, b) {
        (Some(a), Some(b)) if a != b => {
            return Some(format!(
                "--a is in {a}, --b in {b}, and the numbers of both are kept: give --unit {a} or --unit {b} to convert them"
            ));
        }
        (Some(unit), None) if is_from_file(source_b) => ("--a", unit, "--b"),
        (None, Some(unit)) if is_from_file(source_a) => ("--b", unit, "--a"),
        _ => return None,
    };
    Some(format!(
        "{file_with_unit} is in {unit}, {other_file} does not say its unit, and its numbers are taken to be in {unit}, too: give --unit \
         {unit} if they are, or else say in which unit they are, such as part.stl@in"
    ))
}

fn is_from_file(source: &BodySource) -> bool {
    matches!(source, BodySource::Mesh(_) | BodySource::StoredBody(_))
}

fn attach_hull_tree(body: Body) -> Result<Body> {
    let tree = build_hull_tree(body.pieces())?;
    Ok(body.with_hull_tree(tree)?)
}

fn is_same_source(a: &BodySource, b: &BodySource) -> bool {
    match (a, b) {
        (BodySource::StoredBody(a), BodySource::StoredBody(b)) => is_same_file(a, b),
        (BodySource::Mesh(a), BodySource::Mesh(b)) => {
            let same = a.part == b.part && a.adjustments == b.adjustments;
            same && is_same_file(&a.file, &b.file)
        }
        _ => a == b,
    }
}

/// Returns the files that a body is read from; empty for a primitive.
fn files_of_source(source: &BodySource) -> Vec<PathBuf> {
    // An unreadable file is reported when its body is made.
    source.file_paths().unwrap_or_else(|_| match source {
        BodySource::StoredBody(path) => vec![path.clone()],
        BodySource::Mesh(source) => vec![source.file.clone()],
        _ => Vec::new(),
    })
}

/// Returns the checksum of all files of a body; 0 for a primitive or files that cannot be read.
fn checksum(source: &BodySource) -> u32 {
    let mut sum = crc32fast::Hasher::new();
    let files = files_of_source(source);
    let mut add = |path: &PathBuf| ccd_file::read(path).map(|bytes| sum.update(&bytes));
    match files.iter().try_for_each(&mut add) {
        Ok(()) if !files.is_empty() => sum.finalize(),
        _ => 0,
    }
}
